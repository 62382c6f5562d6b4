// The moving state: positions and velocities, contacts and forces, and the masses, laws and damping
// in force.
#pragma once

#include <vector>

#include "blocks/masses.hpp"
#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"
#include "contacts/tiled_faces.hpp"
#include "forces/nodal_forces.hpp"
#include "zones/zone_set.hpp"

namespace edda {

/// By what the laws of joints change at present (LawProgress).
struct LawCourse {
  std::size_t stage = 0;  ///< row of Model::stages
  double began = 0.0;     ///< s, time of the model at its start
  double time = 0.0;      ///< s, LawProgress::time then
  bool held = false;      ///< they stay as they are: a trial
};

struct Motion {
  State state;
  Pose pose;
  Masses masses;  ///< in force
  LawTable laws;  ///< with the strength in force
  LawCourse law_course;
  FaceSet contacts;         ///< the list of faces, and what is decided of them
  TiledFaces tiled;         ///< and their states
  BodyVectors on_contacts;  ///< forces of the contacts at n on the blocks, N; in steps of fixed
                            ///< ones only where the ground moves
  BodyVectors forces;
  ModeVectors locked;  ///< [modes] N, in the frame of each block: forces on its modes that balance
                       ///< the initial stress; or empty
  Zones zones;         ///< evaluated at n
  BodyVectors jump;    ///< jump of the forces at n since the last step (note_jump()); or empty
  std::vector<Vec2> on_dashpots;  ///< [points of dashpots] forces of the dashpots in the last step,
                                  ///< N
  Damping damping;                ///< in force
  bool dynamic = true;  ///< of the implicit method: whether velocities carry over to the next step
};

}  // namespace edda
