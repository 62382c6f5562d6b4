// Lines of the table of keys: what the blocks are cut from.
#pragma once

#include <array>

#include "model/table/rules.hpp"
#include "model/table/slots.hpp"

namespace edda::geometry_keys {

using namespace rules;

// clang-format off
inline constexpr std::array domain_keys{
    Key{"outline", at<&Domain::given_outline>, polygon, otherwise("required unless there is a [slope]"), "Corners of the region that is cut into blocks."},
    Key{"material", at<&Domain::material>, material, otherwise(if_one), "Material of the cut blocks."},
    Key{"joint", at<&Domain::joint>, joint, otherwise("contact.joint"), "Law of cut edges that name none."},
    Key{"snap", at<&Domain::snap>, number(D::length, above(0)), otherwise("1e-9 of the outline's larger side"), "Points closer than this are one point."},
    Key{"max_blocks", at<&Domain::max_blocks>, whole(1, 2e9), initial, "An estimate of the number of blocks above this is an error."},
};

inline constexpr std::array slope_keys{
    Key{"toe", at<&Slope::toe>, point, required, "Foot of the lowest face; the ground is level from the left end to it."},
    Key{"height", at<&Slope::height>, number(D::length, above(0)), required, "Height of the crest above the toe."},
    Key{"face_angle", at<&Slope::face_angle>, number(D::angle, above_to(0, 90)), required, "Angle of each face from the horizontal."},
    Key{"base_y", at<&Slope::base_y>, number(D::length), required, "Level of the bottom of the model."},
    Key{"extent", at<&Slope::extent>, point, required, "Left and right end of the model."},
    Key{"benches", at<&Slope::benches>, whole(1, 1000), initial, "Faces of equal height, one above the other."},
    Key{"bench_width", at<&Slope::bench_width>, number(D::length, from(0)), initial, "Width of the level berm between one face and the next."},
};

inline constexpr std::array cross_section_keys{
    Key{"azimuth", at<&CrossSection::azimuth>, number(D::angle), required, "Bearing of +x, clockwise from north."},
};

inline constexpr std::array deviation_keys{
    Key{"angle", at<&Deviation::angle>, number(D::angle, from_to(0, 90)), initial, "Of the direction on the section, each trace by itself."},
    Key{"spacing", at<&Deviation::spacing>, number(D::length, from(0)), initial, "Of the spacing."},
    Key{"trace_length", at<&Deviation::trace_length>, number(D::length, from(0)), initial, "Of the length of the traces."},
    Key{"gap", at<&Deviation::gap>, number(D::length, from(0)), initial, "Of the gap between traces."},
    Key{"distribution", at<&Deviation::distribution>, choice, initial, "Uniform within these of the mean; normal with these as standard deviations, cut off at three of them; or exponential, as far as lengths go (angles are then normal): these are the standard deviations again, and a deviation as large as the mean puts joints at random."},
};

inline constexpr std::array joint_set_keys{
    Key{"name", at<&JointSet::name>, naming, otherwise("none"), "What --set and messages call the set."},
    Key{"angle", at<&JointSet::given_angle>, number(D::angle), otherwise("required unless dip is given"), "Direction of the joints, counter-clockwise from +x."},
    Key{"dip", at<&JointSet::dip>, number(D::angle, from_to(0, 90)), otherwise("none; in place of angle"), "Dip of the joints; the spacing is then the true one, across them."},
    Key{"dip_direction", at<&JointSet::dip_direction>, number(D::angle), otherwise("none; with dip and section.azimuth"), "Bearing of the line of dip, clockwise from north."},
    Key{"spacing", at<&JointSet::given_spacing>, number(D::length, above(0)), required, "Distance between neighbouring joints, across them."},
    Key{"origin", at<&JointSet::origin>, point, initial, "One joint of the set passes through this point."},
    Key{"joint", at<&JointSet::joint>, joint, otherwise("domain.joint"), "Law of the joints of the set."},
    Key{"region", at<&JointSet::region>, polygon, otherwise("the whole domain"), "The set is only inside this polygon."},
    Key{"trace_length", at<&JointSet::trace_length>, number(D::length, above(0)), otherwise("right through"), "Length of the traces on the section, one after the other along each joint. Without deviations one begins at the origin."},
    Key{"gap", at<&JointSet::gap>, number(D::length, from(0)), initial, "Rock between the end of one trace and the start of the next."},
    Key{"stagger", at<&JointSet::stagger>, number(D::length), otherwise("0; at random where there are deviations"), "Shift of the traces along the joint from each joint to the next, or with bounded_by along the beds from each layer to the next."},
    Key{"bounded_by", at<&JointSet::bounded_by>, naming, otherwise("none"), "Name of another joint set, the beds: each joint runs from one bed to the next."},
    Key{"deviation", at<&JointSet::deviation>, table, initial, "Deviation of single joints from these."},
    Key{"seed", at<&JointSet::seed>, whole(0, 9e15), initial, "Another seed, another set of the same kind."},
};

inline constexpr std::array trace_keys{
    Key{"points", at<&Trace::points>, polyline, required, "The trace of a single joint, a polyline."},
    Key{"joint", at<&Trace::joint>, joint, otherwise("domain.joint"), "Law of the joint."},
};

inline constexpr std::array angle_spread_keys{
    Key{"mean", at<&AngleSpread::mean>, number(D::angle), required, "Mean direction, counter-clockwise from +x."},
    Key{"deviation", at<&AngleSpread::deviation>, number(D::angle, from_to(0, 90)), initial, "Standard deviation, or half the width of a uniform distribution (90: every direction alike)."},
    Key{"distribution", at<&AngleSpread::distribution>, choice, initial, "Uniform, or normal."},
};

inline constexpr std::array length_spread_keys{
    Key{"distribution", at<&LengthSpread::distribution>, choice, initial, "Lognormal, a power law, all alike, or exponential."},
    Key{"mean", at<&LengthSpread::mean>, number(D::length, above(0)), otherwise("required unless it is a power law"), "Mean length."},
    Key{"deviation", at<&LengthSpread::deviation>, number(D::length, from(0)), initial, "Lognormal: standard deviation of the length."},
    Key{"exponent", at<&LengthSpread::exponent>, number(D::plain, above_to(0, 20)), otherwise("required of a power law"), "Power law: the density falls with the length to this power."},
    Key{"min", at<&LengthSpread::min>, number(D::length, above(0)), otherwise("required of a power law"), "Power law: shortest length."},
    Key{"max", at<&LengthSpread::max>, number(D::length, above(0)), otherwise("required of a power law"), "Power law: longest length."},
};

inline constexpr std::array network_keys{
    Key{"name", at<&FractureNetwork::name>, naming, otherwise("none"), "What --set and messages call the network."},
    Key{"model", at<&FractureNetwork::model>, choice, initial, "Traces: their middles are at random and their lengths are those on the section. Baecher: round discs at random in space, whose diameters are the lengths; the section shows chords of them. Veneziano: lines at random, parts of which are fractures, with exponential lengths."},
    Key{"persistence", at<&FractureNetwork::persistence>, number(D::plain, above_to(0, 0.999)), otherwise("required of Veneziano's model"), "Veneziano: part of each line that is fracture."},
    Key{"p21", at<&FractureNetwork::p21>, number(D::per_length, above(0)), otherwise("none; either this or count"), "Length of fractures per area, counted inside the domain."},
    Key{"count", at<&FractureNetwork::count>, whole(1, 5e6), otherwise("none; either this or p21"), "Fractures that show in the domain."},
    Key{"angle", at<&FractureNetwork::angle>, table, required, "Directions."},
    Key{"length", at<&FractureNetwork::length>, table, required, "Lengths of the whole fractures."},
    Key{"joint", at<&FractureNetwork::joint>, joint, otherwise("domain.joint"), "Law of the fractures."},
    Key{"region", at<&FractureNetwork::region>, polygon, otherwise("the whole domain"), "The fractures are only inside this polygon."},
    Key{"seed", at<&FractureNetwork::seed>, whole(0, 9e15), initial, "Another seed, another network of the same kind."},
};

inline constexpr std::array voronoi_keys{
    Key{"size", at<&Voronoi::size>, number(D::length, above(0)), required, "Side of a square as large as the mean polygon."},
    Key{"smoothing", at<&Voronoi::smoothing>, whole(0, 100), initial, "Iterations that make the polygons more alike (Lloyd); 0: none."},
    Key{"min_edge", at<&Voronoi::min_edge>, number(D::length, from(0)), otherwise("size / 5"), "Edges shorter than this become points, and thinner polygons join a neighbour; 0: none do."},
    Key{"joint", at<&Voronoi::joint>, joint, otherwise("domain.joint"), "Law of the polygons' edges."},
    Key{"region", at<&Voronoi::region>, polygon, otherwise("the whole domain"), "Polygons only inside this polygon, which is cut out."},
    Key{"seed", at<&Voronoi::seed>, whole(0, 9e15), initial, "Another seed, other polygons of the same kind."},
};

inline constexpr std::array import_keys{
    Key{"file", at<&Import::file>, file, required, "A drawing (.dxf), traces (.csv: x1,y1,x2,y2 and a joint) or lines of DDA (.geo)."},
    Key{"as", at<&Import::as>, choice, initial, "What the file draws. Lines: they cut the rock of the domain, or what they enclose together. Blocks: each closed polyline is a block, as masonry is drawn, and nothing between them is."},
    Key{"units", at<&Import::units>, choice, initial, "Unit of the coordinates in the file."},
    Key{"scale", at<&Import::scale>, number(D::plain, above(0)), initial, "Factor on the coordinates."},
    Key{"shift", at<&Import::shift>, point, initial, "Added to the coordinates after scaling."},
    Key{"snap", at<&Import::snap>, number(D::length, from(0)), otherwise("what rounding to the last digit of the file can have moved"), "Ends of its lines that stop this close to another line are joined to it; 0: none are."},
    Key{"layers", at<&Import::layers>, rule(Kind::joint_map), otherwise("all layers; one called like a joint has its law"), "The layers that are read, and the law of each."},
    Key{"joint", at<&Import::joint>, joint, otherwise("domain.joint"), "Law of lines whose layer names none."},
    Key{"material", at<&Import::material>, material, otherwise(if_one), "Material of the blocks, where there is no domain, or with as = \"blocks\" where their layer names none."},
    Key{"materials", at<&Import::materials>, rule(Kind::material_map), otherwise("material"), "As blocks: the material of those on a layer."},
    Key{"fixed", at<&Import::fixed>, name_list, otherwise("none"), "As blocks: layers whose blocks do not move."},
};

inline constexpr std::array shape_keys{
    Key{"kind", at<&OpeningShape::kind>, choice, required, "Arch: walls and a round roof. Circle. Rectangle. Horseshoe: a round roof over walls that come in."},
    Key{"at", at<&OpeningShape::at>, point, required, "Middle of the floor; of a circle its centre."},
    Key{"width", at<&OpeningShape::width>, number(D::length, above(0)), required, "Largest width; of a circle its diameter."},
    Key{"height", at<&OpeningShape::height>, number(D::length, above(0)), otherwise("required unless it is a circle"), "From the floor to the crown."},
    Key{"segments", at<&OpeningShape::segments>, whole(8, 2000), initial, "Straight pieces of a full turn, their corners on the curve."},
};

inline constexpr std::array opening_keys{
    Key{"name", at<&Opening::name>, naming, otherwise("none"), "What --set, stages and messages call the opening."},
    Key{"polygon", at<&Opening::given_polygon>, polygon, otherwise("none; either this or shape"), "Outline of the opening."},
    Key{"shape", at<&Opening::shape>, table, otherwise("none; either this or polygon"), "Outline of the opening by a few numbers."},
    Key{"joint", at<&Opening::joint>, joint, otherwise("glued"), "Law of the opening's outline until it is excavated."},
};

inline constexpr std::array region_keys{
    Key{"polygon", at<&Region::polygon>, polygon, required, "Outline of the region, along which blocks are cut."},
    Key{"material", at<&Region::material>, material, otherwise(if_one), "Material of the blocks inside; where regions overlap the last one counts."},
    Key{"joint", at<&Region::joint>, joint, otherwise("glued"), "Law of the outline."},
};

inline constexpr std::array fixed_keys{
    Key{"point", at<&FixedPoint::point>, point, required, "The cut block in which this point lies is fixed."},
};

inline constexpr std::array wall_keys{
    Key{"origin", at<&BrickWall::origin>, point, initial, "Lower left corner of the wall."},
    Key{"columns", at<&BrickWall::columns>, whole(1, 5e6), required, "Bricks in an even row."},
    Key{"rows", at<&BrickWall::rows>, whole(1, 5e6), required, "Rows of bricks."},
    Key{"brick", at<&BrickWall::brick>, shape(Kind::point, D::length, above(0)), required, "Length and height of a brick."},
    Key{"material", at<&BrickWall::material>, material, otherwise(if_one), "Material of the bricks."},
    Key{"joint", at<&BrickWall::joint>, joint, otherwise("contact.joint"), "Law of the bricks' edges."},
};

inline constexpr std::array arch_keys{
    Key{"centre", at<&Arch::centre>, point, initial, "Centre of the arch."},
    Key{"radius", at<&Arch::radius>, number(D::length, above(0)), required, "Radius of the middle line."},
    Key{"thickness", at<&Arch::thickness>, number(D::length, above(0)), required, "From the inner to the outer corners of a voussoir."},
    Key{"count", at<&Arch::count>, whole(1, 1e5), required, "Voussoirs, each as wide as the next."},
    Key{"from_angle", at<&Arch::from_angle>, number(D::angle, from_to(-3600, 3600)), initial, "Where the arch begins, counter-clockwise from +x."},
    Key{"to_angle", at<&Arch::to_angle>, number(D::angle, from_to(-3600, 3600)), initial, "Where it ends, counter-clockwise from there."},
    Key{"material", at<&Arch::material>, material, otherwise(if_one), "Material of the voussoirs."},
    Key{"joint", at<&Arch::joint>, joint, otherwise("contact.joint"), "Law of the voussoirs' edges."},
};

inline constexpr std::array quality_keys{
    Key{"min_area", at<&Quality::min_area>, number(D::area, from(0)), otherwise("4 min_edge^2"), "A cut block smaller than this is a sliver."},
    Key{"min_edge", at<&Quality::min_edge>, number(D::length, from(0)), otherwise("2 % of the smallest spacing, size or 1 / p21"), "A cut block thinner than this is a sliver; shorter edges are reported."},
    Key{"min_angle", at<&Quality::min_angle>, number(D::angle, from_to(0, 60)), initial, "A cut block with a corner sharper than this is merged if that removes the corner."},
    Key{"action", at<&Quality::action>, choice, initial, "Merge slivers into the neighbour across their shortest face that ends a joint (slivers between through-going joints stay, with raised inertia), only report them, or refuse the model."},
};

inline constexpr std::array pair_keys{
    Key{"between", at<&ContactPair::between>, name_list, required, "Two joints, or two materials."},
    Key{"joint", at<&ContactPair::joint>, joint, required, "Law where they meet, whatever the edges name."},
};
// clang-format on

}  // namespace edda::geometry_keys
