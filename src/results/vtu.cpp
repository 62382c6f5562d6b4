#include "results/vtu.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <optional>
#include <string_view>

#include "results/deflate.hpp"
#include "results/number.hpp"

namespace edda {

static_assert(std::endian::native == std::endian::little,
              "frames are written in the machine's own order");

const Field* Grid::cell_field(const std::string& name) const {
  for (const Field& f : cell_fields) {
    if (f.name == name) return &f;
  }
  return nullptr;
}

const Field* Grid::point_field(const std::string& name) const {
  for (const Field& f : point_fields) {
    if (f.name == name) return &f;
  }
  return nullptr;
}

namespace {

constexpr std::size_t in_a_block = std::size_t{1} << 18;  // bytes, each deflated by itself

/// The XML, and the data that follows it: of each array the number of blocks, the size of a block
/// and of the last one where it is shorter (else 0), the sizes of the deflated blocks (all UInt64),
/// then these. Only what is deflated is in memory.
class Writer {
 public:
  std::string xml;

  template <class T>
  void array(const std::string& attributes, const char* type, const std::vector<T>& values) {
    announce(attributes, type, data_.size());
    begin(values.size() * sizeof(T));
    add({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
    end();
  }
  /// Returns where its data begin.
  std::size_t field(const FieldSource& f) {
    const std::size_t at = data_.size();
    announce(f, at);
    f.whole ? make<std::int32_t>(f) : make<double>(f);
    return at;
  }
  /// A field whose data have been written, and begin there.
  void announce(const FieldSource& f, std::size_t at) {
    std::string attributes =
        fmt::format("Name=\"{}\" NumberOfComponents=\"{}\"", f.name, f.components);
    for (std::size_t k = 0; k < f.component_names.size(); ++k) {
      attributes += fmt::format(" ComponentName{}=\"{}\"", k, f.component_names[k]);
    }
    announce(attributes, f.whole ? "Int32" : "Float64", at);
  }
  Trouble write(const std::string& path) const {
    WholeFile file(path);
    file.add(xml);
    file.add(data_);
    file.add("\n</AppendedData>\n</VTKFile>\n");
    return file.complete();
  }

 private:
  void announce(const std::string& attributes, const char* type, std::size_t at) {
    xml += fmt::format("<DataArray type=\"{}\" {} format=\"appended\" offset=\"{}\"/>\n", type,
                       attributes, at);
  }
  /// An array of Number that is made piece by piece.
  template <class Number>
  void make(const FieldSource& f) {
    begin(f.count * f.components * sizeof(Number));
    constexpr std::size_t at_once = 4096;
    std::vector<double> values(at_once * f.components);
    std::vector<Number> numbers;
    for (std::size_t first = 0; first < f.count; first += at_once) {
      const std::size_t last = std::min(first + at_once, f.count);
      f.fill(first, last, values.data());
      numbers.assign(values.begin(),
                     values.begin() + static_cast<std::ptrdiff_t>((last - first) * f.components));
      add({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
    }
    end();
  }
  /// Begins an array of so many bytes.
  void begin(std::size_t size) {
    sizes_ = {(size + in_a_block - 1) / in_a_block, in_a_block, size % in_a_block};
    header_ = data_.size();
    data_.resize(header_ + (sizes_.size() + sizes_.front()) * sizeof(std::uint64_t));
  }
  void add(std::string_view bytes) {
    while (!bytes.empty()) {
      const std::string_view part = bytes.substr(0, in_a_block - block_.size());
      block_ += part;
      bytes.remove_prefix(part.size());
      if (block_.size() == in_a_block) deflate();
    }
  }
  void end() {
    if (!block_.empty()) deflate();
    std::memcpy(data_.data() + header_, sizes_.data(), sizes_.size() * sizeof(std::uint64_t));
  }
  void deflate() {
    const std::string packed = deflated(block_, true);
    sizes_.push_back(packed.size());
    data_ += packed;
    block_.clear();
  }
  std::string data_, block_;          ///< block_: not deflated yet
  std::vector<std::uint64_t> sizes_;  ///< of the array, as they precede it
  std::size_t header_ = 0;            ///< where it begins
};

Fault bad_file(const std::string& path, std::string problem) {
  Fault fault;
  fault.where.file = path;
  fault.problem = std::move(problem);
  fault.remedy = "give a folder that edda run has written";
  return fault;
}

std::string attribute(std::string_view tag, std::string_view name) {
  const std::string wanted = " " + std::string(name) + "=\"";
  const std::size_t at = tag.find(wanted);
  if (at == std::string_view::npos) return {};
  const std::size_t from = at + wanted.size();
  return std::string(tag.substr(from, tag.find('"', from) - from));
}

template <class T>
std::optional<T> number_in(const std::string& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return {};
  return value;
}

/// A number of the header of an array; none behind the end of the bytes.
std::optional<std::uint64_t> number_at(std::string_view bytes, std::size_t at) {
  std::uint64_t number = 0;
  if (at > bytes.size() || bytes.size() - at < sizeof number) return {};
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

/// The bytes of the array that begins there.
std::optional<std::string> bytes_of_array(std::string_view bytes, std::size_t at) {
  constexpr std::size_t step = sizeof(std::uint64_t);
  const auto blocks = number_at(bytes, at), size = number_at(bytes, at + step),
             rest = number_at(bytes, at + 2 * step);
  if (!blocks || !size || !rest || *blocks > bytes.size() / step || *size > in_a_block ||
      *rest >= std::max<std::uint64_t>(*size, 1))
    return {};
  std::string all;
  std::size_t from = at + (3 + *blocks) * step;
  for (std::uint64_t n = 0; n < *blocks; ++n) {
    const auto packed = number_at(bytes, at + (3 + n) * step);
    if (!packed || from > bytes.size() || *packed > bytes.size() - from) return {};
    const bool last = n + 1 == *blocks && *rest > 0;
    const auto block = inflated(bytes.substr(from, *packed), last ? *rest : *size);
    if (!block) return {};
    all += *block;
    from += *packed;
  }
  return all;
}

/// The values of one <DataArray> tag, from the bytes behind the XML.
template <class T>
bool values_of(std::string_view tag, std::string_view bytes, std::vector<T>& out) {
  const auto offset = number_in<std::size_t>(attribute(tag, "offset"));
  if (!offset) return false;
  const std::optional<std::string> found = bytes_of_array(bytes, *offset);
  if (!found || found->size() % sizeof(T) != 0) return false;
  out.resize(found->size() / sizeof(T));
  if (!found->empty()) std::memcpy(out.data(), found->data(), found->size());
  return true;
}

bool read_field(std::string_view tag, std::string_view bytes, std::vector<Field>& fields) {
  Field f;
  f.name = attribute(tag, "Name");
  f.components = number_in<std::size_t>(attribute(tag, "NumberOfComponents")).value_or(1);
  f.whole = attribute(tag, "type") == "Int32";
  if (f.whole) {
    std::vector<std::int32_t> numbers;
    if (!values_of(tag, bytes, numbers)) return false;
    f.values.assign(numbers.begin(), numbers.end());
  } else if (!values_of(tag, bytes, f.values)) {
    return false;
  }
  fields.push_back(std::move(f));
  return true;
}

bool read_array(std::string_view section, std::string_view tag, std::string_view bytes, Grid& g) {
  if (section == "PointData") return read_field(tag, bytes, g.point_fields);
  if (section == "CellData") return read_field(tag, bytes, g.cell_fields);
  if (section == "Points") return values_of(tag, bytes, g.points);
  if (section == "FieldData") {
    std::vector<double> time;
    if (!values_of(tag, bytes, time) || time.size() != 1) return false;
    g.time = time[0];
    return true;
  }
  const std::string name = attribute(tag, "Name");
  if (name == "connectivity") return values_of(tag, bytes, g.corners);
  if (name == "offsets") return values_of(tag, bytes, g.ends);
  return values_of(tag, bytes, g.types);
}

/// Checks the properties of known fields on which readers of frames rely.
struct KnownField {
  std::string_view name;
  std::size_t components;
  bool whole;
};
constexpr std::array known_fields{KnownField{"id", 1, true},
                                  KnownField{"material", 1, true},
                                  KnownField{"fixed", 1, true},
                                  KnownField{"displacement", 3, false},
                                  KnownField{"velocity", 3, false},
                                  KnownField{"rotation", 1, false},
                                  KnownField{"omega", 1, false},
                                  KnownField{"stress", 6, false},
                                  KnownField{"overstress", 1, false},
                                  KnownField{"principal_stress", 3, false},
                                  KnownField{"plastic_strain", 1, false},
                                  KnownField{"yields", 1, true},
                                  KnownField{"strength_factor", 1, false},
                                  KnownField{"pore_pressure", 1, false},
                                  KnownField{"block_i", 1, true},
                                  KnownField{"block_j", 1, true},
                                  KnownField{"state", 1, true},
                                  KnownField{"normal_force", 1, false},
                                  KnownField{"shear_force", 1, false},
                                  KnownField{"opening", 1, false},
                                  KnownField{"slip", 1, false},
                                  KnownField{"force", 3, false},
                                  KnownField{"length", 1, false},
                                  KnownField{"closed_length", 1, false},
                                  KnownField{"normal_stress", 1, false},
                                  KnownField{"shear_stress", 1, false},
                                  KnownField{"normal_stress_a", 1, false},
                                  KnownField{"normal_stress_b", 1, false},
                                  KnownField{"damage", 1, false},
                                  KnownField{"broken_by", 1, true},
                                  KnownField{"x_a", 1, false},
                                  KnownField{"y_a", 1, false},
                                  KnownField{"x_b", 1, false},
                                  KnownField{"y_b", 1, false},
                                  KnownField{"aperture", 1, false},
                                  KnownField{"discharge", 1, false},
                                  KnownField{"water_pressure", 1, false},
                                  KnownField{"head", 1, false}};

bool fits(const Field& f, std::size_t count) {
  if (f.components == 0 || f.values.size() % f.components != 0) return false;
  if (f.values.size() / f.components != count) return false;
  return std::all_of(known_fields.begin(), known_fields.end(), [&](const KnownField& known) {
    return f.name != known.name || (f.components == known.components && f.whole == known.whole);
  });
}

/// Whether the arrays are consistent with each other, so that users of the grid need not check.
bool consistent(const Grid& g) {
  if (g.points.size() % 3 != 0 || g.types.size() != g.ends.size()) return false;
  std::int64_t before = 0;
  for (const std::int64_t end : g.ends) {
    if (end <= before) return false;
    before = end;
  }
  if (before != static_cast<std::int64_t>(g.corners.size())) return false;
  for (const std::int64_t c : g.corners) {
    if (c < 0 || c >= static_cast<std::int64_t>(g.point_count())) return false;
  }
  for (const Field& f : g.cell_fields) {
    if (!fits(f, g.cell_count())) return false;
  }
  for (const Field& f : g.point_fields) {
    if (!fits(f, g.point_count())) return false;
  }
  return true;
}

std::vector<FieldSource> sources_of(const std::vector<Field>& fields) {
  std::vector<FieldSource> sources;
  for (const Field& f : fields) {
    const auto fill = [&f](std::size_t first, std::size_t end, double* into) {
      std::copy_n(f.values.begin() + static_cast<std::ptrdiff_t>(first * f.components),
                  (end - first) * f.components, into);
    };
    const std::size_t count = f.components == 0 ? 0 : f.values.size() / f.components;
    sources.push_back({f.name, f.components, f.component_names, f.whole, count, fill});
  }
  return sources;
}

/// The fields of `grid` are not looked at.
Trouble write(const std::string& path, const Grid& grid,
              const std::vector<FieldSource>& point_fields,
              const std::vector<FieldSource>& cell_fields) {
  Writer w;
  w.xml =
      "<?xml version=\"1.0\"?>\n"
      "<!-- Stresses of blocks are positive in tension, normal forces and normal stresses of "
      "joints in compression; all values are in SI units, angles in rad. -->\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n<FieldData>\n";
  const std::vector<double> time{grid.time};
  w.array("Name=\"TimeValue\" NumberOfTuples=\"1\"", "Float64", time);
  w.xml +=
      fmt::format("</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<PointData>\n",
                  grid.point_count(), grid.cell_count());
  std::vector<std::size_t> at;
  for (const FieldSource& f : grid.cells_are_points ? cell_fields : point_fields)
    at.push_back(w.field(f));
  w.xml += "</PointData>\n<CellData>\n";
  for (std::size_t n = 0; n < cell_fields.size(); ++n) {
    if (grid.cells_are_points) {
      w.announce(cell_fields[n], at[n]);
    } else {
      w.field(cell_fields[n]);
    }
  }
  w.xml += "</CellData>\n<Points>\n";
  w.array("Name=\"Points\" NumberOfComponents=\"3\"", "Float64", grid.points);
  w.xml += "</Points>\n<Cells>\n";
  w.array("Name=\"connectivity\"", "Int64", grid.corners);
  w.array("Name=\"offsets\"", "Int64", grid.ends);
  w.array("Name=\"types\"", "UInt8", grid.types);
  w.xml += "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  return w.write(path);
}

}  // namespace

Grid grid_of(GridSource source) {
  Grid grid = std::move(source.shape);
  const auto add = [](const std::vector<FieldSource>& sources, std::vector<Field>& fields) {
    for (const FieldSource& f : sources) {
      fields.push_back({f.name, f.components, std::vector<double>(f.count * f.components),
                        f.component_names, f.whole});
      f.fill(0, f.count, fields.back().values.data());
    }
  };
  add(source.point_fields, grid.point_fields);
  add(source.cell_fields, grid.cell_fields);
  return grid;
}

Trouble write_vtu(const std::string& path, const Grid& grid) {
  return write(path, grid, sources_of(grid.point_fields), sources_of(grid.cell_fields));
}

Trouble write_vtu(const std::string& path, const GridSource& source) {
  return write(path, source.shape, source.point_fields, source.cell_fields);
}

Result<Grid> read_vtu(const std::string& path) {
  const Result<std::string> file = read_file(path);
  if (!file.ok()) return file.faults();
  const std::string_view text = file.value();
  constexpr std::string_view mark = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t split = text.find(mark);
  if (split == std::string_view::npos) return bad_file(path, "is no frame of a run");
  const std::string_view xml = text.substr(0, split), bytes = text.substr(split + mark.size());
  if (xml.find("vtkZLibDataCompressor") == std::string_view::npos) {
    Fault fault = bad_file(path, "is of an earlier version of edda");
    fault.remedy = "run the model again";
    return fault;
  }
  Grid grid;
  std::string section;
  for (std::size_t at = xml.find('<'); at != std::string_view::npos; at = xml.find('<', at + 1)) {
    if (xml.substr(at).starts_with("<!--")) {
      at = xml.find("-->", at);
      if (at == std::string_view::npos) break;
      continue;
    }
    const std::string_view tag = xml.substr(at, xml.find('>', at) - at);
    if (!tag.starts_with("<DataArray ")) {
      if (!tag.starts_with("</")) section = std::string(tag.substr(1, tag.find_first_of(" >") - 1));
    } else if (!read_array(section, tag, bytes, grid)) {
      return bad_file(path, "is cut short or damaged at array \"" + attribute(tag, "Name") + "\"");
    }
  }
  if (!consistent(grid)) return bad_file(path, "is damaged: its arrays do not fit together");
  return grid;
}

Trouble write_pvd(const std::string& path, const std::vector<SeriesEntry>& series) {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const SeriesEntry& e : series) {
    xml += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", shortest(e.time),
                       e.file);
  }
  return write_file(path, xml + "</Collection>\n</VTKFile>\n");
}

Result<std::vector<SeriesEntry>> read_pvd(const std::string& path) {
  const Result<std::string> file = read_file(path);
  if (!file.ok()) return file.faults();
  const std::string_view text = file.value();
  std::vector<SeriesEntry> series;
  for (std::size_t at = text.find("<DataSet "); at != std::string_view::npos;
       at = text.find("<DataSet ", at + 1)) {
    const std::string_view tag = text.substr(at, text.find('>', at) - at);
    const auto time = number_in<double>(attribute(tag, "timestep"));
    const std::string name = attribute(tag, "file");
    if (!time || name.empty()) return bad_file(path, "is no time series of a run");
    series.push_back({*time, name});
  }
  return series;
}

}  // namespace edda
