#include "results/tables.hpp"

#include <array>

#include "results/columns.hpp"
#include "results/csv_file.hpp"

namespace edda {

Trouble write_blocks_csv(const std::string& path, std::span<const BlockRecord> blocks) {
  Csv csv = begin_table(ResultFile::blocks);
  return write_rows(path, csv, blocks.size(), [&](std::size_t i) {
    const BlockRecord& b = blocks[i];
    csv.add(b.id).add(b.name).add(b.material).add(b.position.x).add(b.position.y).add(b.area);
    csv.add(b.displacement.x).add(b.displacement.y).add(b.rotation);
    csv.add(b.velocity.x).add(b.velocity.y).add(b.omega);
    csv.add(b.sxx).add(b.syy).add(b.szz).add(b.sxy);
    csv.add(b.overstress).end();
  });
}

Trouble write_joints_csv(const std::string& path, std::span<const ContactRecord> contacts) {
  constexpr std::array state_names{"open", "stick", "slide", "bonded"};
  constexpr std::array crack_names{"", "tension", "shear"};
  Csv csv = begin_table(ResultFile::joints);
  return write_rows(path, csv, contacts.size(), [&](std::size_t k) {
    const ContactRecord& c = contacts[k];
    csv.add(c.block_i).add(c.block_j).add(c.joint).add(c.position.x).add(c.position.y);
    csv.add(c.normal_force).add(c.shear_force).add(c.opening).add(c.slip);
    csv.add(state_names[static_cast<std::size_t>(c.state)]);
    csv.add(int{c.ever_slipped}).add(int{c.ever_opened}).add(c.mobilised);
    csv.add(c.length).add(c.closed_length).add(c.a.x).add(c.a.y).add(c.b.x).add(c.b.y);
    csv.add(c.normal_stress).add(c.normal_stress_a).add(c.normal_stress_b);
    csv.add(c.shear_stress).add(c.table).add(c.damage);
    csv.add(crack_names[static_cast<std::size_t>(c.crack)]);
    csv.add(c.aperture).add(c.discharge).add(c.water_pressure_a).add(c.water_pressure_b).end();
  });
}

}  // namespace edda
