#include <algorithm>
#include <array>

#include "results/columns.hpp"
#include "results/columns_over_time.hpp"

namespace edda {
namespace column_table {

constexpr std::array blocks{
    C{"id", "1", "Number of the block, from 0."},
    C{"name", "text", "Name of the block; empty where it has none."},
    C{"material", "text", "Name of its material."},
    C{"x", "m", "Coordinate x of the centroid at the end of the run."},
    C{"y", "m", "Coordinate y of the centroid at the end of the run."},
    C{"area", "m2", "Area of the deformed block."},
    C{"ux", "m",
      "Displacement of the centroid to the right since the start or the last reset of "
      "displacements."},
    C{"uy", "m",
      "Displacement of the centroid upwards since the start or the last reset of displacements."},
    C{"rotation", "rad",
      "Rotation of the block since the start, positive counter-clockwise, full turns counted."},
    C{"vx", "m/s", "Velocity of the centroid to the right."},
    C{"vy", "m/s", "Velocity of the centroid upwards."},
    C{"omega", "rad/s", "Angular velocity, positive counter-clockwise."},
    C{"sxx", "Pa", "Stress xx of the block, positive in tension."},
    C{"syy", "Pa", "Stress yy of the block, positive in tension."},
    C{"szz", "Pa", "Stress out of plane, positive in tension."},
    C{"sxy", "Pa", "Shear stress xy of the block."},
    C{"overstress", "1",
      "Part of the strength of the intact rock that the stress takes up; above 1 the rock would "
      "fail. 0 where the material has no strength."},
};

constexpr std::array joints{
    C{"block_i", "1",
      "Id of one block; the signs of shear_force and slip are those of its motion."},
    C{"block_j", "1",
      "Id of the other block, which lies on the left on the way from end a to end b."},
    C{"joint", "text", "Name of the joint's law, or glued where that is the built-in one."},
    C{"x", "m", "Coordinate x of the middle of the overlap of the two edges."},
    C{"y", "m", "Coordinate y of the middle of the overlap of the two edges."},
    C{"normal_force", "N", "Normal force, positive in compression."},
    C{"shear_force", "N", "Shear force, positive where it drives block_i from end a to end b."},
    C{"opening", "m",
      "Opening of the joint at its more closed end, as the surfaces are drawn; negative where they "
      "are pressed into each other."},
    C{"slip", "m",
      "Shear displacement of block_i against block_j since the start, positive from end a to end "
      "b."},
    C{"state", "text", "State of the contact now: open, stick, slide or bonded."},
    C{"ever_slipped", "1", "1: the contact has slipped at some time; 0: it has not."},
    C{"ever_opened", "1", "1: the contact has been open at some time; 0: it has not."},
    C{"mobilised", "1",
      "Shear force over shear strength, without sign; 0 for glued edges and without a shear "
      "force."},
    C{"length", "m", "Length of the overlap."},
    C{"closed_length", "m", "Length of the part of the overlap that carries."},
    C{"x_a", "m", "Coordinate x of end a of the overlap."},
    C{"y_a", "m", "Coordinate y of end a of the overlap."},
    C{"x_b", "m", "Coordinate x of end b of the overlap."},
    C{"y_b", "m", "Coordinate y of end b of the overlap."},
    C{"normal_stress", "Pa",
      "Normal force over the area of the whole overlap, positive in compression."},
    C{"normal_stress_a", "Pa",
      "Normal stress at end a, positive in compression; it is linear over the closed length and 0 "
      "at an open end."},
    C{"normal_stress_b", "Pa", "Normal stress at end b, positive in compression."},
    C{"shear_stress", "Pa",
      "Shear force over the area of the whole overlap, with the sign of shear_force."},
    C{"table", "text",
      "Table of the model from which the line of the joint comes, as joint_set.bedding or "
      "trace.0; empty for blocks that are given as such."},
    C{"damage", "1",
      "Part of its tensile strength and cohesion that a joint with fracture energy has lost, the "
      "mean of both ends; 0 of others."},
    C{"broken_by", "text",
      "What has spent most of the fracture energy of a joint that is broken: tension or shear; "
      "empty of others."},
    C{"aperture", "m",
      "Hydraulic aperture of a joint through which water flows ([flow]), uniform with the same "
      "discharge; 0 of others."},
    C{"discharge", "m2/s",
      "Discharge of the joint per metre of thickness, positive from end a to end b."},
    C{"water_pressure_a", "Pa", "Pressure of that water at end a."},
    C{"water_pressure_b", "Pa", "Pressure of that water at end b."},
};

constexpr std::array flow{
    C{"time", "s", "Time of the frame."},
    C{"water", "text",
      "Name of a [[water]], or its number where it has none; open: faces of blocks beside which "
      "there is air."},
    C{"inflow", "m2/s",
      "What flows from it into the joints per metre of thickness; negative: out of them."},
};

constexpr std::array fos{
    C{"factor", "1",
      "Factor by which strength is divided, or a load, a water or a ground motion multiplied."},
    C{"outcome", "text", "Outcome of the trial: holds or fails."},
    C{"displacement", "m", "Largest displacement of a corner since the start of the trial."},
    C{"block", "1", "Id of the block of that corner; empty where there is none."},
    C{"time", "s", "Time since the start of the trial."},
    C{"velocity", "m/s", "Largest mean speed of a corner between the last two checks."},
    C{"unbalanced", "1", "Mean resultant force as in the column ratio of stages.csv."},
    C{"steps", "1", "Number of time steps of the trial."},
    C{"reason", "text", "Reason for the outcome."},
};

constexpr std::array mechanism{
    C{"id", "1", "Number of the block, from 0."},
    C{"name", "text", "Name of the block; empty where it has none."},
    C{"x", "m", "Coordinate x of the centroid before the motion."},
    C{"y", "m", "Coordinate y of the centroid before the motion."},
    C{"ux", "m", "Displacement of the centroid to the right in the mechanism alone."},
    C{"uy", "m", "Displacement of the centroid upwards in the mechanism alone."},
    C{"displacement", "m", "Largest displacement of a corner of the block."},
    C{"rotation", "rad", "Rotation of the block, positive counter-clockwise."},
    C{"turning_part", "1",
      "Rotation without sign times the distance of the furthest corner from the centroid, over the "
      "displacement of the centroid: about 1 for a block that turns about a corner, 0 for one that "
      "slides."},
    C{"motion", "text", "Kind of motion: slides, topples, falls, hinges or yields."},
};

constexpr std::array mechanism_joints{
    C{"block_i", "1", "Id of one block."},
    C{"block_j", "1", "Id of the other block."},
    C{"joint", "text", "Name of the joint's law."},
    C{"x", "m", "Coordinate x of the contact of the two blocks that moves most."},
    C{"y", "m", "Coordinate y of the contact of the two blocks that moves most."},
    C{"slip", "m", "Largest displacement along the joint of the two blocks against each other."},
    C{"opening", "m", "Largest opening of the joint in the mechanism."},
    C{"turning", "m",
      "Rotation of the two blocks against each other times the length of the joint."},
    C{"motion", "text", "Kind of motion: slips, opens or hinges."},
    C{"table", "text",
      "Table of the model from which the line of that contact comes, as joint_set.bedding or "
      "trace.0; empty for blocks that are given as such."},
};

constexpr std::array key_blocks{
    C{"block", "1", "Id of the block; of several that are glued together the first."},
    C{"name", "text", "Its name, where it has one."},
    C{"x", "m", "Coordinate x of its centroid."},
    C{"y", "m", "Coordinate y of its centroid."},
    C{"area", "m2", "Area of the block, or of those that are glued together."},
    C{"weight", "N", "Its weight, of the thickness of the model."},
    C{"class", "text",
      "key: its factor is below the one asked for; held: above it; stable: it stays without any "
      "friction."},
    C{"mode", "text", "falls, slides, slides on two faces, rotates, or stays."},
    C{"joints", "text", "Names of the joints on which it slides."},
    C{"direction", "rad", "Direction of its motion by translation, counter-clockwise from +x."},
    C{"factor_translation", "1",
      "Factor of safety against falling or sliding; empty where it does neither."},
    C{"factor_rotation", "1",
      "Factor of safety of the block alone between neighbours that do not move, by rigid limit "
      "analysis; empty where no factor moves it."},
    C{"factor", "1", "The lower one of both."},
    C{"generation", "1",
      "1: it can leave, or leaves, as drawn; 2: once the key blocks of generation 1 have gone; and "
      "so on."},
    C{"support", "N",
      "Force against the direction of its motion with which it has the factor asked for; empty "
      "where it rotates."},
};

constexpr std::array study{
    C{"sample", "1", "Number of the sample, from 0."},
    C{"NAME", "as varied",
      "Value of a quantity of [vary], in the unit that it gives, or that of its key.",
      ColumnOf::quantity},
    C{"NAME", "as asked",
      "Answer to an [ask]: a number; \"unstable\" where there is no equilibrium at all; "
      "\"unlimited\" where there is no limit; empty where there is no answer.",
      ColumnOf::answer},
    C{"failed", "1",
      "1 where the sample fails by [failure], 0 where it does not; empty where this is not known."},
    C{"message", "text", "Why there is no answer."},
};

constexpr std::array map{
    C{"x", "m", "Coordinate x of the place."},
    C{"y", "m", "Coordinate y."},
    C{"rock", "1", "Samples in which there is rock at the place."},
    C{"key", "1", "Samples in which it belongs to a key block."},
    C{"part", "1", "Part of all samples with an answer in which it belongs to a key block."},
};

constexpr std::array limit_joints{
    C{"block_i", "1", "Id of one block."},
    C{"block_j", "1", "Id of the other block."},
    C{"joint", "text", "Name of the joint's law."},
    C{"x", "m", "Coordinate x of the thrust: where the resultant goes through the joint."},
    C{"y", "m", "Coordinate y of the thrust."},
    C{"normal_force", "N", "Normal force of the joint at the limit, positive in compression."},
    C{"shear_force", "N", "Shear force, positive where it drives block i from end a to end b."},
    C{"fx", "N", "Force on block i to the right."},
    C{"fy", "N", "Force on block i upwards."},
    C{"mobilised", "1",
      "Shear force without sign over the shear strength; 1 where the joint slides."},
    C{"ax", "m", "Coordinate x of end a of the joint."},
    C{"ay", "m", "Coordinate y of end a."},
    C{"bx", "m", "Coordinate x of end b; the same point as a where a corner leans on an edge."},
    C{"by", "m", "Coordinate y of end b."},
    C{"table", "text",
      "Table of the model from which the line of the joint comes, as joint_set.bedding or "
      "trace.0; empty for blocks that are given as such."},
};

constexpr C of_direction{"direction", "text", "x: to the right; y: upwards."};
constexpr C of_event{"stage", "1",
                     "Number of the stage of the ground motion, from 1; 0 without stages."};
constexpr C period_column{"period", "s", "Natural period of the oscillator."};

constexpr std::array motions{
    C{"monitor", "text", "Name of the monitor; second/first: of one relative to another."},
    of_direction,
    of_event,
    C{"start", "s", "Time at which the stage, or the run, began."},
    C{"end", "s", "Time at which it ended."},
    C{"peak_acceleration", "m/s2",
      "Largest magnitude of the acceleration, the mean from row to row."},
    C{"peak_velocity", "m/s", "Largest magnitude of the velocity."},
    C{"peak_displacement", "m", "Largest magnitude of the displacement since the start."},
    C{"permanent_displacement", "m", "Displacement from the start to the end."},
    C{"arias", "m/s", "Arias intensity, pi/(2 g) times the integral of the squared acceleration."},
    C{"arias_duration", "s", "Time in which it grows from 5 to 95 % of its final value."},
};

constexpr std::array spectra{
    C{"monitor", "text", "Name of the monitor."},
    of_direction,
    of_event,
    period_column,
    C{"pseudo_acceleration", "m/s2",
      "Largest displacement of the oscillator relative to the monitor, times (2 pi/period)^2."},
    C{"relative_velocity", "m/s", "Largest velocity of the oscillator relative to the monitor."},
    C{"relative_displacement", "m",
      "Largest displacement of the oscillator relative to the monitor."},
};

constexpr std::array amplification{
    of_direction,
    of_event,
    period_column,
    C{"amplification", "1",
      "Pseudo-acceleration at the second monitor over that at the first; empty where the first "
      "does not move."},
};

constexpr std::array relative{
    of_event,
    time_column,
    C{"ux", "m",
      "Displacement to the right of the second monitor less that of the first, since the start of "
      "the stage."},
    C{"uy", "m", "The same upwards."},
};

constexpr std::array columns{
    C{"file", "text", "Name of a file of this folder."},
    C{"column", "text", "Name of one of its columns, as in its header."},
    C{"unit", "text", "Unit; 1 for a number without dimension, text for words."},
    C{"meaning", "text", "Meaning of the column with its sign convention."},
};

constexpr std::array cut{
    C{"block", "1", "Number of the block, from 0."},
    C{"material", "text", "Name of its material."},
    C{"ring", "1", "0: the outer ring, counter-clockwise; from 1: a hole, clockwise."},
    C{"x", "m", "Coordinate x of the corner."},
    C{"y", "m", "Coordinate y of the corner."},
    C{"joint", "text",
      "Law of the edge from this corner to the next; empty where the model names none, so that "
      "contact.joint holds."},
    C{"table", "text",
      "Table of the model from which the line of the edge comes, as joint_set.bedding or "
      "trace.0; empty for blocks that are given as such."},
};

constexpr std::array<ResultTable, 24> tables{{
    {"history.csv",
     "A row at the start, at each multiple of output.history_every and at the end of each stage; "
     "stages until equilibrium have more (output.settling).",
     history},
    {"reactions.csv", "A row for each row of history.csv, of models with boundaries.", reactions},
    {"bolts.csv", "A row for each node of each installed bolt in each frame, of models with bolts.",
     bolts},
    {"linings.csv",
     "Two rows for each piece of each installed lining in each frame, of models with linings.",
     linings},
    {"flow.csv",
     "A row for each water, and one for the open faces, in each frame, of models with [flow].",
     flow},
    {"stages.csv", "A row for each stage that has ended, of models with stages.", stages},
    {"curve.csv", "A row for each increment of a ramp, of models with stages that have one.",
     curve},
    {"joints_N.csv", "The contacts at the end of stage N, with the columns of joints.csv.", joints,
     TableIn::folder_by_stage},
    {"bolt_summary.csv",
     "A row for each installed bolt at the end of the run, of models with bolts.", bolt_summary},
    {"blocks.csv",
     "A row for each block that is there at the end of the run; excavated blocks have none.",
     blocks},
    {"joints.csv",
     "A row for each contact of two edges at the end of the run that is closed, or that has opened "
     "after having been closed. Forces are those of the thickness of the model.",
     joints},
    {"fos.csv", "A row for each trial of edda fos.", fos},
    {"mechanism.csv",
     "A row for each block that moves at the lowest factor that failed, or at the limit that edda "
     "limit finds.",
     mechanism},
    {"mechanism_joints.csv",
     "A row for each joint between two blocks that slips, opens or hinges in the mechanism.",
     mechanism_joints},
    {"limit_joints.csv",
     "A row for each joint that carries a force at the limit that edda limit finds.", limit_joints},
    {"keyblocks.csv",
     "A row for each block that can leave the rock (edda keyblocks), key blocks first.",
     key_blocks},
    {"study.csv", "A row for each sample of a study (edda study), in the folder of the study.",
     study},
    {"key_block_map.csv", "A row for each place of [map] of a study where any sample has rock.",
     map},
    {"motions.csv",
     "A row for each monitor, direction and stage with a ground motion (edda spectra).", motions},
    {"spectra.csv",
     "Response spectra (edda spectra): a row for each monitor, direction, stage with a ground "
     "motion and period.",
     spectra},
    {"amplification.csv", "A row for each direction, stage and period (edda spectra --between).",
     amplification},
    {"relative.csv",
     "The motion of one monitor relative to another (edda spectra --between): a row for each row "
     "of history.csv in the stages with a ground motion.",
     relative},
    {"columns.csv", "A row for each column of each table in the folder.", columns},
    {"F.csv", "A row for each corner of each block, written by edda cut -o F.csv.", cut,
     TableIn::file_of_user},
}};

constexpr bool is_complete(const ResultTable& table) {
  return !table.rows.empty() &&
         std::all_of(table.columns.begin(), table.columns.end(), [](const ResultColumn& c) {
           return !c.name.empty() && !c.unit.empty() && !c.meaning.empty();
         });
}
static_assert(std::all_of(tables.begin(), tables.end(), is_complete));
static_assert(tables.size() == static_cast<std::size_t>(ResultFile::cut) + 1);

}  // namespace column_table

std::span<const ResultTable> result_tables() {
  return column_table::tables;
}

const ResultTable& result_table(ResultFile file) {
  return column_table::tables[static_cast<std::size_t>(file)];
}

}  // namespace edda
