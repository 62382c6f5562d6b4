"""The rows of docs/validation.md in words. Numbers that were computed come from the records alone."""
import dataclasses

from verification import exact


@dataclasses.dataclass(frozen=True)
class Row:
    """One problem. leave_out: facts of the recorded model that its run changes."""

    number: int
    title: str
    model: str
    exact: str
    note: str = ""
    leave_out: tuple = ()


def _overhang(bricks):
    return 0.5 * sum(1.0 / k for k in range(1, bricks + 1))


ROWS = (
    Row(1, "The paper's ramp",
        "A block of 2 x 1 m is released on a fixed ramp of slope a, with friction phi, and slides for 0.1 s. It"
        " starts without stress. Cases are named slope/friction in degrees.",
        "A rigid block slides s = g t^2 (sin a - tan phi cos a)/2 (Coulomb; the paper's Eq. 42).",
        "Gravity acts at once on the block without stress: it drops on its contact springs and oscillates. This is"
        " nearly all of the error; it decreases with stiffer rock, and row 2 is without it."),
    Row(2, "The ramp, started with its stress",
        "The ramp of row 1, brought to steady sliding first: strong mass damping makes the block slide at a constant"
        " speed v0, and exerts the force that inertia will exert, so that all forces are those of sliding. Then the"
        " damping is removed.",
        "s = v0 t + g t^2 (sin a - tan phi cos a)/2. The first term is subtracted on both sides."),
    Row(3, "Stick or slip within a tenth of a degree",
        "The ramp of row 2, with 0.1 degrees less friction than slope, and with 0.1 degrees more.",
        "With less it slides as in row 2. With more it sticks. The uphill end of the face has slipped to its limit,"
        " the shear spring of the downhill end has the remaining force, (W sin a - N_up tan phi)/p_t, where N_up = W"
        " cos a/2 - W sin a/4 is the normal force that statics gives for the uphill end under a 2 x 1 m block."),
    Row(4, "Critical cohesion",
        "The block of row 1 on 30 degrees, with 15 degrees of friction, held by cohesion on its 2 m of joint; loaded"
        " without overshoot by strong damping. Stiffness of the joint as the program chooses it (\"springs per"
        " contact\"), or given per length (kn and ks). Below the critical cohesion the damping is removed when the"
        " bond breaks.",
        "Statics: c L = W sin a - W cos a tan phi. After the break there is no cohesion and the block slides as in"
        " row 1."),
    Row(5, "Rocking",
        "A block of 1 x 3 m is released on its corner at half its critical tilt. Time until it stands flat, for the"
        " three mass matrices.",
        "A quarter of the period of theta'' = -p^2 sin(alpha - theta), p^2 = 3 g/4 R, alpha = atan(1/3), R half the"
        " diagonal (Housner 1963), integrated numerically; 2.44947/4 s. The lumping `covering` has the inertia of"
        " three masses on a triangle round the block: its p^2 is g R/(R_c^2 + R^2), R_c being the nodes' distance"
        " from the centroid, and it is compared with that."),
    Row(6, "Free spin",
        "A unit square, plane stress, spins freely at 20 rad/s for ten turns. It starts without stress, so it"
        " oscillates about its stretched shape.",
        "A block of uniform strain carries the mean centrifugal stress sigma = rho omega^2 a^2/12 in both directions"
        " (virial theorem), so its area grows by 2 sigma (1 - nu)/E; the oscillation is that times 1 - cos(w t), w^2"
        " = 12 E/((1 - nu) rho a^2). Angular momentum does not change."),
    Row(7, "Natural frequencies of a free block",
        "A free block of 2 x 1 m, plane strain, started in each of its three modes by the velocities of that mode. Its"
        " strain crosses zero every half period.",
        "Stretch: w^2 are the eigenvalues of (12/rho) [C11/a^2, C12/a^2; C12/b^2, C22/b^2]. Shear:"
        " w^2 = 12 G (a^2 + b^2)/(rho a^2 b^2). Both follow from the kinetic energy of a uniform strain rate."),
    Row(8, "Bounce on two corners",
        "A unit square falls 0.1 mm on two of its corners, undamped, repeatedly, on contact springs 200 times softer"
        " than the rock. Steps from 0.1 to 0.8 of the critical one.",
        "A mass on a spring without tension, w^2 = 2 p_n/m: contact time [pi + 2 atan(g/(w v))]/w, v = sqrt(2 g H);"
        " depth d + sqrt(d^2 + 2 d H), d = m g/2 p_n. Energy does not change.",
        "The rock is not rigid: this is the remaining error, at every step."),
    Row(9, "Column under its own weight",
        "Ten unit squares on a fixed base, plane stress, no friction, in equilibrium. Cases: the explicit method with"
        " mass damping; the implicit one.",
        "The stress in the middle of a block is -rho g times its depth. The top settles by rho g H^2/2E + sum N_i/K, the"
        " blocks' own shortening and that of the springs, K = 2 p_n an interface."),
    Row(10, "Pulse along a column",
        "200 unit squares in a row, plane stress, nu = 0, bonded, free at both ends, without gravity. A pulse of"
        " velocity, a Gauss curve of standard deviation 10 m, starts about block 41; half of it travels to the far"
        " end. kappa = K L/(E A) is the joints' stiffness over the blocks'.",
        "Springs in series: c = sqrt(E/rho)/sqrt(1 + 1/kappa). The free end moves twice as fast as the pulse, by"
        " superposition of its mirror image. The speed is that between blocks 81 and 161."),
    Row(11, "Critical step",
        "The bound of the step that the program computes, block by block, for a column of 200 unit squares.",
        "The largest frequency of an infinite row of such blocks gives the step L/(c0 sqrt(3 (1 + kappa))), c0 ="
        " sqrt(E/rho), kappa as in row 10. The bound may not be above it, nor below 0.7 of it.",
        "The bound is that of blocks that touch others all round ([contacts.md](contacts.md)), which those of a"
        " column do not: where the joints are much stiffer than the blocks, this costs a factor of sqrt 2."),
    Row(12, "Snap-through of a three-hinged beam",
        "Two stiff halves of 2 x 0.15 m between fixed abutments are in contact with each other and with these at"
        " their corners. Gravity is raised slowly until they snap through: to 0.85 of the exact load in the first 5"
        " s, then to 1.1 of it in 11 s.",
        "Three springs p_n in a row carry the thrust, so W = (16/3) p_n y (t^2 - y^2)/S^2 at the rise y = t - sag, with"
        " its peak 16 K t^3/(3 sqrt3 S^2), K = 2 p_n/3, at y = t/sqrt3.",
        "Computed is the load at which the sag passes 0.8 t: a beam that has begun to fall needs some time for this,"
        " while the load still increases.", leave_out=("gravity",)),
    Row(13, "Semicircular arch",
        "An arch of 16 equal voussoirs, centre line of radius R = 5 m, on fixed springings, under its own weight.",
        "It stands where some thrust line stays within it: t/R of at least"
        f" {exact.arch_limit(16):.4f} (limit analysis, Heyman 1969, here by linear conditions on all joints; 0.1075 for"
        " endlessly many voussoirs). So it must stand at 0.1085 and collapse at 0.107.",
        "The arch that collapses is drawn at the moment when a voussoir has sunk by 0.5 m."),
    Row(14, "Gravity dam with rising water",
        "A dam of 2 x 8 m, 24 kN/m3, on fixed rock, without uplift. Water rises on one side within 2 s, to a depth"
        " that is found by bisection.",
        "The moments of the water, gamma_w h^3/6, and of the weight, gamma_c B^2 H/2, about the toe are equal at"
        " h = (3 gamma_c B^2 H/gamma_w)^(1/3).",
        "A dam counts as overturned when its crest has moved by 50 mm 4 s after the start. Just above the limit"
        " overturning takes longer."),
    Row(15, "Harmonic overhang",
        "Four bricks of 1 x 0.25 m, each overhanging the one below by L/2i, i counted from the top, times a factor.",
        f"Statics: the top brick can overhang the table by at most (1/2)(1 + 1/2 + 1/3 + 1/4) L = {_overhang(4):.4f} L. All"
        " joints reach their limit together.",
        "The stack that collapses is drawn at the moment when the top brick has sunk by 0.2 m."),
    Row(16, "Corner on corner",
        "A unit square standing on its corner falls 20 mm on the corner of a fixed one, 1 nm to the right of it, or"
        " to the left.",
        "The two paths are mirror images. The contact force does not jump: in a step h it changes by no more than p_n"
        " v h, and by half as much more where corners pass each other."),
    Row(17, "The ramp in ten pieces",
        "The ramp of row 1 with the ramp itself cut into ten fixed blocks, so that the slider passes the boundaries"
        " between them.",
        "It slides as on one piece. No boundary between pieces may cause an impact: the sum of normal forces stays"
        " under 2.1 W cos a, which a block to which gravity is applied at once nearly reaches by itself.",
        "Without damping of the rock the stiff vibrations of so many faces may be excited by the sliding"
        " ([theory.md](theory.md)); with it contact damping of 0.02 makes no difference."),
    Row(18, "A wall in equilibrium",
        "Eight rows of eight bricks, 1 x 0.5 m, undamped; with gravity applied at once (\"as drawn\") or from"
        " equilibrium (\"settled\").",
        "Energy does not change: as drawn, kinetic energy after the first second is no larger than in it. From"
        " equilibrium, it is at the level of rounding, and no face that carries more than 1e-9 of a brick's weight"
        " opens or closes.",
        "Tests compute 40,000 steps, `tools/rest-study wall` a million."),
    Row(19, "Momentum and indifference",
        "Twenty polygons of three to six corners, with initial velocities towards each other, without gravity; and"
        " the same rotated by 0.7 rad (\"turned\"), mirrored, and with the blocks in another order.",
        "Linear and angular momentum do not change. Rotated, mirrored or renumbered, the motion is the same."),
    Row(20, "Four blocks in a box",
        "Four unit squares that meet at a point, plane strain, no friction, compressed by a fixed box that is a"
        " little too small in both directions.",
        "Two blocks and three interfaces K = 2 p_n in series share the closure: 2 e_x + 3 s_x/K = -2 dx, likewise"
        " along y, with e from s by Hooke's law in plane strain. No force acts across the diagonals.",
        "The remaining error is of second order in the strain, which a linear answer neglects: half the compression"
        " halves it."),
    Row(21, "Friction and damping only dissipate",
        "Six unit squares, each rotated by 0.13 rad more than the one below, fall on each other and on a fixed base.",
        "The energy dissipated by friction and damping never decreases, and the energy balance closes."),
    Row(30, "A block under ground motion",
        "A block of 2 x 1 m on a fixed slope of 20 degrees with 30 degrees of friction, ground motion along x, a sine"
        " of 0.5 g and 2 Hz: as inertia forces on all blocks, and by moving the slope. Mean of the second and third"
        " cycle.",
        "A rigid block slides while the driving force exceeds its friction, until it is as fast as the ground"
        " (Newmark 1965), integrated numerically: 0.078405 m in each cycle."),
    Row(31, "A wave into a viscous boundary",
        "A bar of 120 glued unit blocks, in plane strain, on rollers that prevent motion across the wave. A pulse of"
        " velocity travels down into a viscous boundary; joints fifty times as stiff as the rock, or as stiff as it,"
        " with the wave speeds of the jointed bar given.",
        "A boundary of impedance rho c reflects nothing (Lysmer and Kuhlemeyer 1969).",
        "Largest reflected velocity over that of the incident pulse."),
    Row(32, "An upgoing wave",
        "The bar of row 31 with stiff joints; a sine of acceleration of 10 Hz enters through its viscous base.",
        "On its way up it has v = A/w (1 - cos w t), at the free end twice that."),
    Row(33, "A grouted bolt pulled out",
        "A bolt of 25 mm and 4 m, half of it in either of two stiff blocks that are moved apart along it. Bond 1"
        " GN/m2, 400 kN/m.",
        "Shear lag: N falls off from the joint as sinh(lambda (L - x)), lambda = sqrt(K/EA). The bond first slips at"
        " the joint, where K u = strength, and fails as a whole when P = strength L."),
    Row(34, "A bolted joint in shear",
        "One block is moved over another along a joint with a grouted bolt at a right angle to it, spacing 1.5 m.",
        "The bolt adds its dowel stiffness, up to its strength, over its spacing.",
        leave_out=("gravity",)),
    Row(35, "A block suspended from a bolt",
        "A block of 2 x 2 m is suspended from an end-anchored bolt of 30 mm and 4 m, spacing 2 m, installed with no"
        " tension or with 40 kN.",
        "In equilibrium the bolt is longer by (W - T0) L/EA, as the model has them, that is per metre of thickness."),
    Row(36, "Free-field sides",
        "A square of 24 m of rock in glued blocks of 3 m, free-field sides, a viscous base; a sine of acceleration of"
        " 6 Hz enters through it.",
        "The ground has no lateral end, so every point of the surface moves by twice v = A/w (1 - cos w t)."),
    Row(37, "Ground in equilibrium under its initial stress",
        "20 x 20 m of jointed rock under an initial stress, by tensor and gradient or by k0 and the weight above, uncut by any"
        " opening, undamped: oblique joint sets, traces that end in the rock, Voronoi polygons, layers, water, boundaries of"
        " every type, both methods, every mass matrix.",
        "No motion. The forces on each block are in equilibrium where the gradient of the stress is density times"
        " gravity; the reactions, with water, equal the weight."),
    Row(38, "A circular opening",
        "A hole of 1 m radius, cut at once from Voronoi polygons that are glued by joints twice as stiff as the"
        " blocks, under 10 MPa horizontally and 20 MPa vertically; fixed 16 m away. Beyond 4 m rings of larger blocks"
        " with the same joint compliance.",
        "Kirsch (1898), plane strain, with shear modulus and Poisson's ratio of a square of the same mass under"
        " pressure. Stress is compared by rings as wide as a block, without the one at the wall, by its mean and its"
        " second harmonic.",
        "The polygons are not small beside the opening, and the constants are those of a square of the mass. Smaller and larger blocks: `kirsch_long_test.cpp`."),
    Row(40, "Factor of safety of a ramp",
        "The block of row 1 on 30 degrees; the strength of its joint is divided by a factor.",
        "A block slides where tan(phi)/F = tan(a)."),
    Row(41, "Factor of safety of a plane slide",
        "A block over a plane of 35 degrees that daylights in a face of 60 degrees, 12 m high, an open tension crack"
        " behind it; cohesion on the plane, water in the crack and on the plane, with a pressure that falls from the"
        " foot of the crack to zero at the toe.",
        "Limit equilibrium (Hoek and Bray 1981): resistance [c A + (W cos p - U - V sin p) tan(phi)] over drive"
        " (W sin p + V cos p)."),
    Row(42, "A growing load",
        "A block on level ground is pushed by a tenth of its weight times a factor, low down or high up; one is"
        " lifted by one and a half times its weight, with its joint in tension, and is pushed along it.",
        "It slides at P = W tan(phi), or tips at P h = W b/2; the joint in tension carries c b - N tan(phi)."),
    Row(43, "Toppling slope of Goodman and Bray",
        "Sixteen columns 10 m wide on a stepped base of 30 degrees, 4 to 40 m high, crest at the tenth; the numbers of Hoek and"
        " Bray's example.",
        "From block to block down the slope each passes on the force that prevents it from toppling or sliding"
        " (Goodman and Bray 1976); block 1 needs none at 38.15 degrees (38.13 without rounding). Blocks 16 to 14"
        " stay, 13 to 4 topple, 3 to 1 slide."),
    Row(44, "A growing ground motion",
        "A block on 20 degrees with 35 degrees of friction; all blocks undergo a horizontal acceleration that rises"
        " to 1 m/s2 times a factor and then stays constant.",
        "It slides from g tan(phi - a) on."),
    Row(45, "Water of growing unit weight",
        "The dam of row 14 with 5 m of water, whose unit weight is multiplied by a factor.",
        "It overturns where F gw h^3/6 = gc B^2 H/2."),
    Row(46, "Direct shear: slip weakening",
        "A block with an initial velocity along a level joint whose friction falls from 40 to 20 degrees over 8 mm of"
        " slip.",
        "Friction dissipates N times the integral of tan(phi(u)) du, until the motion ends."),
    Row(47, "Direct shear: dilation",
        "A block on a level joint of 30 degrees that opens at 5 degrees, with a driving force slightly above the"
        " friction.",
        "It rises by tan(psi) u. N is the weight and the inertia force of the rise, so a = (gx - g tan(phi))/(1 +"
        " tan(phi) tan(psi)).",
        leave_out=("gravity",)),
    Row(48, "Direct shear: Barton and Bandis",
        "A block on a level joint with JRC 9, JCS 60 MPa and 28 degrees of residual friction, driven under strong"
        " damping, at three normal stresses; the driving force at which it slides, by bisection.",
        "Peak strength tan(phi_r + JRC log10(JCS/sigma)) (Barton and Choubey 1977), dilation half of the angle above"
        " phi_r.", leave_out=("gravity",)),
    Row(50, "What statics holds does not creep",
        "One block or four side by side, 1 x 1, 2 x 1 and 3 x 3 m, on slopes a few degrees less steep than friction,"
        " with gravity applied at once, without initial stress; damping, stiffness and step as the program chooses"
        " them. Cases are named slope/friction in degrees.",
        "Nothing moves after the first oscillations: none of these blocks slides or topples.",
        "Without damping of the blocks' strain the same blocks creep by centimetres to a metre in a second."),
    Row(51, "Slides at high friction",
        "Blocks as in row 50 on slopes steeper than friction, one second after a start without stress.",
        "g t^2 (sin a - tan phi cos a)/2."),
    Row(52, "A slide that reverses",
        "With an initial velocity uphill a block comes to a stop and slides back; its position is taken after three"
        " times the time of its way up.",
        "It is braked by g (sin a + cos a tan phi) on its way up and accelerated by g (sin a - cos a tan phi) on its"
        " way down."),
    Row(53, "Newmark's block at four sets of angles",
        "A block comes to equilibrium and then undergoes ground motion of three cycles of a sine along x that begins"
        " at zero.",
        "A rigid block that slides while the driving force exceeds friction, in either direction; integrated in"
        " 300,000 steps (Newmark 1965)."),
    Row(54, "Toppling about a toe",
        "A slender block on a slope too steep for it rotates about its lower corner for 0.6 s.",
        "The pendulum theta'' = g r m/J sin(a - alpha + theta), tan alpha width over height; the toe stays.",
        "A third of a percent is the block's own elasticity at the sudden start."),
    Row(55, "Restitution",
        "A block 1 m wide is released at half of its critical tilt and rocks on joints with `restitution ="
        " \"housner\"`; blocks of many shapes fall on joints with a number, flat and on a corner. Default damping of the"
        " rock.",
        "With the striking corner fixed and an impulse there alone, an impact leaves (1 - 3/2 sin^2 alpha)^2 of the"
        " energy, tan alpha width over height (Housner 1963). A fall leaves the part of the velocity that was"
        " given, and so does the impact of two free blocks on each other, of their relative velocity.",
        "The dashpots of a number follow the pressure, so that the part does not depend on shape and mass; what is"
        " left is the strain of the blocks."),
    Row(56, "Slopes of several blocks",
        "A slab of twenty blocks on a plane; a jointed mass on a plane with cohesion, dry and with water; one on a"
        " stepped base; an active and a passive wedge; six slices on a curved base, dry and with water. Strength is"
        " divided by a factor.",
        "Beds and cross joints: the least of [c L + (W cos a - U - V') tan phi]/(W sin a + V) over all paths that"
        " only step up. Wedges and slices: all bases and joints between them at their limit together (Sarma 1979),"
        " from the top slice down.",
        "Where the base bends there is a small hollow: the corner of a slice would rest on the rock below."
        " `tools/study-fos` tries these and larger ones."),
    Row(57, "An arch of four hinges",
        "The arch of row 13, thickness a fifth of its radius, under a growing load on its haunch.",
        "The least load of all mechanisms of four hinges, alternately at the outer and the inner edge of the joints (Heyman 1966)."),
    Row(58, "A joint in bending",
        "A block 2 m wide on a joint whose stiffness k is given is loaded at an eccentricity e, in equilibrium.",
        "Glued: M/(k L^3/12). Without tension the same up to e = L/6; beyond, the length a = 3 (L/2 - e) carries a"
        " triangle of pressure, and the rotation is 2 N/(k a^2)."),
    Row(59, "Columns on soft joints",
        "Columns of one block and of three stand on ground that is tilted slowly and then kept at its tilt; glued"
        " ones sway after a push.",
        "From the top down each joint rotates as in row 58 under the weight above, in the inclined position: for one"
        " block the limit is the largest atan(2 e/H) - 2 N/(9 k (B/2 - e)^2). Sway: each block has the displacement"
        " of its centre, the rotation of its level edges and that of its vertical edges, between them springs k L,"
        " k_s L and k L^3/12."),
    Row(60, "Crossing joints under pressure",
        "Wedges that meet at a point, four blocks round a crossing, three at a joint that ends on another, under a pressure all round"
        " of 0.1 MPa that rises slowly; with a joint stiffness of 20 GPa/m, and with none.",
        "Every joint closes by the same, so that every block has that pressure.",
        "The remaining error is proportional to the closure over the length of the joints."),
    Row(61, "Slides over many pieces",
        "The block of row 1, E 200 MPa, slides 42.5 m over 190 boundaries between pieces, flush, or each piece 0.1 mm higher or lower than the last. A block"
        " between two rows of pieces slides at 8 m/s in a fault under 10 MPa.",
        "v^2/2 = a s - g cos(a) h, h the mean rise under the ends of the block. The compression stays constant.",
        "Where corners pass each other the overlap is shorter by r/4 ([contacts.md](contacts.md)): in the fault 1.2e-4 m, twice that where both"
        " ends of the block do at once."),
    Row(62, "Cohesion under a bent base",
        "A force along its base is raised to 1.001 of its strength; the sliding mass is kept at a steady speed by"
        " damping in proportion to mass. The toe, a fifth of the base, bends up by an angle, or the floor bends down"
        " there.",
        "c L + N tan phi, L the whole base."),
    Row(63, "Slopes as rigid blocks",
        "Slopes of row 56 and larger ones, up to 547 blocks, by `edda limit`: the factor by which strength may be divided.",
        "As in row 56. A plane or a path of planes on which a mass slides in one direction has the same factor whether joints"
        " dilate or not."),
    Row(64, "Toppling as rigid blocks",
        "The sixteen blocks of Goodman and Bray (1976) by `edda limit`, with joints that dilate as they slide and with joints that"
        " do not.",
        "Limit equilibrium from block to block, with friction mobilised on all sides, has 1.0006. Joints that dilate have a larger"
        " factor; successive programs that begin with the least thrust find 0.997 to 1.005 ([limit.md](limit.md))."),
    Row(65, "A panel under slow loads",
        "Six courses of masonry, 33 units of 0.4 x 0.175 m and halves, under a seismic coefficient that `edda fos` raises slowly.",
        "The limit load of rigid blocks, 0.6428590 (Ferris and Tin-Loi 2001); stiffness does not matter.",
        "The factor is the middle of a bracket of 0.6 %."),
    Row(66, "Corners that lean, sliding",
        "A sled of 3 m on two pointed feet, of which the sides rise at two angles from the ground; gravity is tilted by the slope."
        " Default settings.",
        "Below the friction angle it stays; beyond it slides as a rigid block.",
        "Friction acts along the edge on which a corner leans (theory, section 4.3)."),
    Row(67, "A bar that leans against a wall",
        "A bar of 4 m x 0.3 m with its lower corner on the floor and its upper one at the wall.",
        "Friction at its limit at both corners, moments about the lower one.",
        "The factor is the middle of a bracket of 0.6 %."),
    Row(68, "A bonded joint in bending",
        "A block of 1 x 4 m, bonded to level ground and pushed at mid-height; a block that juts out of a wall, 1.5 m long and 1 m"
        " high. With penalty springs and with kn of 2e10 Pa/m.",
        "The bond breaks where the stress of its outer fibre, -N/L + 6 M/L^2, is its tensile strength.",
        "Rigid limit analysis has the moment t L^2/2 of a bond that yields, three times as much ([limit.md](limit.md))."),
    Row(69, "Cohesion under water",
        "A block of 4 m x 2 m with cohesion on a plane of 35 degrees, above which a stage raises a lake; a dam of 3 m x 6 m with"
        " cohesion, with and without a little tensile strength, under 5 m of water with uplift.",
        "(c A + W' cos a tan phi)/(W' sin a) with the weight W' under buoyancy; (c B + (W - U) tan phi)/H.",
        "Water compresses the block by far more than its weight does, so that its joint would gape while the lake rises. The heel"
        " of the dam cracks. The factors are the middle of a bracket of 0.4 %."),
    Row(70, "Newmark's block under records",
        "A block of 2 m x 1 m on a plane of 15 degrees with friction of 25, under 18 made records (sums of twelve sines under an"
        " envelope, with peaks of 0.3 and 0.6 g), each with both signs, after it has come to equilibrium.",
        "A rigid block that slides while the driving force exceeds friction, in either direction; integrated with 200 steps for"
        " each interval of the record (Newmark 1965)."),
    Row(71, "Closures of a tunnel in blocks",
        "A circular tunnel of 3 m radius in rock of 10 GPa under 10 MPa from the sides and 20 MPa from above, cut into glued blocks;"
        " the squares reach to 20 radii, six metres wide beyond four radii. Measured 5 cm behind the wall.",
        "Kirsch (1898). The joints of squares are as stiff in shear as across, so the rock with its joints is isotropic:"
        " 2 G = 1/((1 + nu)/E + 1/(k s)). For running bond and polygons: the same joints between blocks that are divided into fine"
        " triangles, in the same box."),
    Row(72, "Meshed blocks, elastic",
        "A cantilever of 10 m x 1 m as one block under a force at its end; a block of 1 m x 4 m that falls back until it is upright,"
        " meshed coarsely and finely; a circular opening in one block, 30 radii from the rollers, zones of 0.06 radii at the wall.",
        "A beam with shear; a pendulum of exact inertia; Kirsch (1898): the mean of the closure and its part in cos 2t.",
        "The error of the cantilever is proportional to the square of the zones' size: two zones across it are few."),
    Row(73, "An opening in rock after Mohr and Coulomb",
        "A circular opening of 1 m in one block, rollers at 20 m, zones of 0.06 m at the wall that grow by 0.15 per metre: phi 30 deg,"
        " c 3.45 MPa, E 680 GPa (small strains) under 30 MPa. Hoop stresses as means over eight rings between the wall and twice the plastic zone.",
        "Salencon (1969).",
        "Zones half as large halve the error."),
    Row(74, "An opening in rock after Hoek and Brown",
        "The same opening in rock of sigma_ci 75 MPa, m 3.43, s 0.0205, a 0.5 under 30 MPa.",
        "Equilibrium of the ring and its flow, integrated (Carranza-Torres 2004)."),
    Row(75, "A strip footing",
        "Half of a rough rigid strip of 2 m on rock without friction, c 100 kPa, pushed in by 20 mm; zones of 0.2 m.",
        "(2 + pi) c (Prandtl 1920), on the width and half a zone beside it."),
    Row(76, "A slope under a lake that goes down",
        "A slope of 2:1, 10 m high, phi 20 deg, c 10 kPa, 20 kN/m3, in zones of 0.8 m, with water in its pores and on its face: a level"
        " lake and table up to the crest, 7 m lower, and none.",
        "Griffiths and Lane (1999), by finite elements: 1.85, 1.30 and 1.40."),
    Row(77, "A slope of clay",
        "A slope of 1:2, 5 m high, of undrained clay of 20 kPa, with as much clay below its toe, in zones of 1 m.",
        "Taylor's (1937) chart: c/(F gamma H) = 0.17."),
    Row(78, "Joints with fracture energy",
        "A plate of two halves, pulled apart or sheared, as blocks and in zones. Discs of polygons, pressed along their diameter.",
        "G_I and G_II for each area of the joint. The strength of a body does not depend on its grains."),
    Row(79, "A sample that softens",
        "A sample of 1 by 2 m in zones between smooth platens, 1 MPa at its sides, shortened by 12 mm; its cohesion falls from 1 to"
        " 0.2 MPa over 5 mm of slip.",
        "Coulomb's strength at the peak and after it; one band of Tresca's rock dissipates half of c times the slip beyond the rest.",
        "Parts of the bands still soften at the end, so the residual stress comes out high."),
    Row(80, "Joints that change",
        "A block rests on a ramp of 30 deg by friction of 45 deg and cohesion until the joint weathers to 15 deg. A column of two blocks"
        " stands until one or both of its joints become ten times softer, and is loaded then.",
        "It slides from rest as with 15 deg from the beginning. Nothing moves by the change, and the load meets the new stiffness."),
    Row(81, "Linings as beams",
        "Cantilevers of a lining, straight in 16 pieces and as a quarter circle in 96, with their ends glued into rock; a ring of 64"
        " pieces under pressure from outside, and one whose concrete becomes three times as stiff between two pressures.",
        "Deflection with shear; thrust p r and closure p r^2/EA, of each pressure with the stiffness of its time.",
        "The ring is a polygon, a thousandth smaller than its circle."),
    Row(82, "Vibration of a lining",
        "A cantilever 20 times as long as thick swings freely after a push.",
        "The first mode of a beam, with shear and rotary inertia (Southwell's sum of compliances)."),
    Row(83, "A plastic hinge",
        "A lining on two supports is pushed down at its middle until it fails.",
        "4 M_p/L (limit analysis)."),
    Row(84, "A lined tunnel",
        "A circular tunnel of 5 m radius in ground of 1 GPa under 1 MPa vertically and 0.5 MPa horizontally, lined at once by 20 cm of"
        " concrete, bonded to the ground or without friction.",
        "Einstein and Schwartz (1979), with the ground at the outer face of the lining."),
    Row(85, "A lining that comes later",
        "The same under 1 MPa all round, lined when 0.6 of the wall forces have been released.",
        "0.4 of the thrust of a lining from the beginning."),
    Row(86, "A column in lifts",
        "A column of 10 m of concrete of 1 GPa is built in ten lifts, each in equilibrium before the next one, and at once.",
        "Each lift settles by its own weight and by what comes after it, with the joints below it; the top of the last one least."),
    Row(87, "Fill between walls that close",
        "Two walls close by 5 mm, fill of 10 m length is placed between them, and they close by another 2 mm.",
        "The stress of 2 mm in fill, joints, walls and springs in a row."),
    Row(90, "A ring that buckles",
        "A free ring of 64 pieces, a fortieth as thick as its radius, is pinched and let go: it swings as an oval, without and under"
        " half of the critical pressure on its outer face.",
        "omega^2 = 7.2 EI/(m r^4) (1 - p/p_c) (Love 1927); p_c = 3 EI/r^3 of a pressure that turns with its face (Levy 1884)."
        " The critical pressure follows from the two periods."),
    Row(92, "Uplift under a dam",
        "A dam 20 m wide on one joint has 15 m of water before it and 3 m behind it, without drains and with drain holes 4 m behind its"
        " heel.",
        "The weight less the uplift, which is linear between heads."),
    Row(93, "A joint closes and conducts less",
        "A joint with kn lies under a block 50 m high, with still water of 6 m at its ends.",
        "Its aperture as drawn less effective stress over kn."),
    Row(94, "Flow to a tunnel",
        "Two sets of joints 1 m apart are drained by a tunnel of 4 m radius; the head is given at 16 m.",
        "Radial flow in a continuum of the same conductivity (cubic law)."),
    Row(95, "Pressure diffuses along a joint",
        "The pressure at one end of a joint between rigid walls is raised; its other end is closed.",
        "Series with c = h^2 K/(12 mu) (Carslaw and Jaeger 1959)."),
    Row(96, "A joint consolidates",
        "Twenty columns side by side on a joint are loaded by 10 kPa more, and the joint drains to one side.",
        "The same series with c = h^3/(12 mu (1/kn + h/K))."),
    Row(97, "Water that is shut in",
        "The same load while the water has no time to flow, with a bulk modulus K = kn h.",
        "Water takes K/(K + kn h) of the load, half of it."),
    Row(98, "Time enough is steady flow",
        "The groundwater beside a slope rises from 2 to 15 m, and has 100 h.",
        "Pressures of steady flow."),
    Row(99, "A joint sheared across a bar",
        "The joint of row 34, with a bolt of 25 mm and 500 MPa whose dowel follows from it, in rock that bears 15 GPa and 50 MPa.",
        "Two beams on their foundations, E I beta^3; two plastic hinges, sqrt(2 M_p p). Both over the spacing."),
    Row(100, "Shear tests of bolted joints",
        "A joint with friction of 30 degrees is sheared until its bolt breaks, of 25 mm, 500 MPa and a rupture strain of 5 %, at 0 to 30"
        " degrees from its normal, in rock of 40 to 80 MPa. What the bolt adds, with the friction that it gives, over its tensile"
        " strength.",
        "Spang and Egger (1990), fitted to tests.",
        "In weaker and in harder rock and at larger angles the bar differs more from the fit (theory, section 14.2)."),
    Row(101, "Joints that change gradually",
        "A block on a plane of 30 deg while its joint goes from one law to another, by a ramp and over a second; a block that hangs by"
        " tensile strength; a column whose joints become softer.",
        "Strength and load along the plane are equal at a part of the change. Stiffness that changes moves nothing."),
    Row(102, "Joints that lose strength with time",
        "The same blocks on joints whose strength decays exponentially to the residual one, in a ramp of time and in the time of a stage.",
        "The time at which the strength is the load; after it the block slides with the residual friction."),
    Row(103, "A borehole opens a joint",
        "Water is injected for 4 s into a joint of meshed elastic rock under 5 MPa, of which the joint takes no tension: a quarter"
        " of the fracture.",
        "The plane-strain fracture of Geertsma and de Klerk without toughness and lag (self-similar; Adachi and Detournay 2002).",
        "Zones of 1 m beside a fracture of 18 m, 32 increments."),
    Row(104, "A borehole splits rock",
        "The same in rock with tensile strength and fracture energy, by water of a hundredth of the viscosity.",
        "A crack under the uniform pressure that gives it the volume injected and the toughness of the rock.",
        "Half of the energy of the fracture is that of the modelled side. The joint has next to no shear stiffness: it lies in a plane"
        " of symmetry."),
)
