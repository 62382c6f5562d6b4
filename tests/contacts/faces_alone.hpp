// The oracle of the tiles: faces stepped one by one, each from its state and the positions alone.
#pragma once

#include <vector>

#include "contacts/evaluate_face.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/joint_strength.hpp"

namespace edda {

struct FacesAlone {
  FaceSet faces;
  FaceStates states;
  std::vector<double> forces;  ///< corner_forces()

  /// A new list.
  void find(const BlockSet& b, const State& state, const Pose& pose, const LawTable& laws,
            const Reach& reach, NearEdges& near) {
    std::vector<std::uint8_t> carry;
    for (const FaceFields& m : states.now) carry.push_back(m.energy > 0.0 ? 1 : 0);
    const std::vector<Id> old = find_faces(faces, b, state, pose, laws, reach, near, carry);
    FaceStates next(faces.size());
    std::vector<double> on(8 * faces.size(), 0.0);
    for (std::size_t k = 0; k < faces.size(); ++k) {
      if (old[k] == no_id) continue;
      next.now[k] = states.now[old[k]];
      next.before[k] = states.before[old[k]];
      std::copy_n(&forces[8 * old[k]], 8, &on[8 * k]);
    }
    states = next;
    forces = on;
  }

  /// Evaluates all faces at n from their states at n - 1, with what is decided of them.
  void evaluate(const FaceScene& scene, double step) {
    for (std::size_t k = 0; k < faces.size(); ++k) {
      decide_face(faces, scene, step, states.before[k], k);
      const EvaluatedFace now = evaluate_face(faces, scene, step, states.before[k], k);
      states.now[k] = now.state;
      put(&forces[8 * k], now.force);
    }
  }

  /// Makes step n final.
  void next_step() {
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const FaceFields& m = states.now[k];
      (faces.is(FaceFlag::fails, k) ? faces.fracture_work : faces.friction_work)[k] +=
          m.friction_work;
      if (faces.dashpots) faces.damping_work[k] += m.damping_work + m.damping_due;
      faces.transfer[k] += m.transfer;
      if (is_cut(FaceEnds{m.trial_a, m.trial_b}, FaceEnds{m.slip_a, m.slip_b}))
        faces.set(FaceFlag::slipped, k);
      if (states.before[k].energy > 0.0 && m.energy == 0.0) faces.set(FaceFlag::opened, k);
    }
    count_failures(faces);
    states.before = states.now;
  }
};

}  // namespace edda
