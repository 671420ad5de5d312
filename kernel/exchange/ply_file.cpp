// PLY, binary little-endian: a text header that names the properties, then one record per vertex (doubles)
// and one per face (a count of 1 byte, indices of 4).
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <set>
#include <string_view>

#include "kernel/base/error.hpp"
#include "kernel/base/text_file.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "kernel/exchange/mesh_formats.hpp"

namespace blendwright {
namespace {

static_assert(std::endian::native == std::endian::little, "written as the memory has it");

constexpr std::string_view head = "ply\nformat binary_little_endian 1.0\n", last_line = "end_header\n";

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A comment is one line of the header.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return text;
}

/// Names of properties are words; each is there once.
class PropertyNames {
 public:
  std::string unused(std::string name) {
    for (char& c : name)
      if (static_cast<unsigned char>(c) <= ' ') c = '_';
    while (!used_.insert(name).second) name += '_';
    return name;
  }

 private:
  std::set<std::string> used_;
};

std::string header_of(const TriMesh& mesh) {
  std::string text(head);
  text += "comment written by blendwright\n";
  if (!mesh.note.empty()) text += "comment " + one_line(mesh.note) + '\n';
  text += "element vertex " + std::to_string(mesh.points.size()) + '\n';
  PropertyNames names;
  const auto property = [&](const std::string& name) {
    text += "property double " + names.unused(name) + '\n';
  };
  for (const char* name : {"x", "y", "z"}) property(name);
  if (!mesh.normals.empty())
    for (const char* name : {"nx", "ny", "nz"}) property(name);
  for (const Column& c : mesh.columns)
    for (int k = 0; k < c.components; ++k)
      property(c.components == 1 ? c.name : c.name + '_' + std::to_string(k));
  text += "element face " + std::to_string(mesh.triangles.size()) + '\n';
  text += "property list uchar uint vertex_indices\n";
  text += last_line;
  return text;
}

// --- reading
// -----------------------------------------------------------------------------------------------

struct ScalarType {
  std::string_view name, other_name;
  std::size_t bytes;
  double (*read)(const char* at);
};
template <class T>
double read_as(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}
constexpr ScalarType scalar_types[] = {
    {"char", "int8", 1, read_as<std::int8_t>},    {"uchar", "uint8", 1, read_as<std::uint8_t>},
    {"short", "int16", 2, read_as<std::int16_t>}, {"ushort", "uint16", 2, read_as<std::uint16_t>},
    {"int", "int32", 4, read_as<std::int32_t>},   {"uint", "uint32", 4, read_as<std::uint32_t>},
    {"float", "float32", 4, read_as<float>},      {"double", "float64", 8, read_as<double>}};

struct Property {
  std::string name;
  const ScalarType* type = nullptr;
  const ScalarType* count = nullptr;  ///< of a list
};
struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    words.emplace_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

class PlyReader {
 public:
  PlyReader(const std::filesystem::path& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  TriMesh read() {
    mesh_.name = file_.stem().string();
    read_header();
    for (const Element& element : elements_) {
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element);
      else
        fail("it has an element \"" + element.name + "\", must have \"vertex\" and \"face\" only");
    }
    if (at_ != bytes_.size()) fail(std::to_string(bytes_.size() - at_) + " bytes follow the last element");
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const { fail_reading(file_, why); }

  const ScalarType* type_named(const std::string& name) const {
    for (const ScalarType& t : scalar_types)
      if (t.name == name || t.other_name == name) return &t;
    fail("it has a property of type \"" + name + "\"");
  }

  void read_header() {
    if (bytes_.substr(0, head.size()) != head) fail("it is not a binary little-endian PLY");
    at_ = head.size();
    for (;;) {
      const std::size_t end = bytes_.find('\n', at_);
      if (end == std::string_view::npos) fail("its header does not end");
      const std::vector<std::string> words = words_of(bytes_.substr(at_, end - at_));
      at_ = end + 1;
      const std::string key = words.empty() ? "" : words[0];
      if (key == "end_header") return;
      if (key == "element" && words.size() == 3)
        elements_.push_back({words[1], count_of(words[2]), {}});
      else if (key == "property" && !elements_.empty() && words.size() == 3)
        elements_.back().properties.push_back({words[2], type_named(words[1]), nullptr});
      else if (key == "property" && !elements_.empty() && words.size() == 5 && words[1] == "list")
        elements_.back().properties.push_back({words[4], type_named(words[3]), type_named(words[2])});
      else if (key != "comment" && key != "obj_info")
        fail("its header has a line \"" + key + " ...\" that is not understood");
    }
  }

  [[nodiscard]] std::size_t count_of(const std::string& word) const {
    std::size_t n = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), n);
    // Every element takes a byte at least.
    if (error != std::errc() || end != word.data() + word.size() || n > bytes_.size())
      fail("it cannot hold \"" + word + "\" elements");
    return n;
  }

  double next(const ScalarType& type) {
    if (bytes_.size() - at_ < type.bytes) fail("it ends too early");
    const double value = type.read(bytes_.data() + at_);
    at_ += type.bytes;
    return value;
  }

  void read_vertices(const Element& element) {
    std::array<std::optional<std::size_t>, 6> vectors;  // which property is x, y, z, nx, ny, nz
    constexpr std::array names{"x", "y", "z", "nx", "ny", "nz"};
    std::vector<std::size_t> others;
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      if (element.properties[p].count) fail("a vertex has a list");
      const auto known = std::find(names.begin(), names.end(), element.properties[p].name);
      if (known != names.end())
        vectors[static_cast<std::size_t>(known - names.begin())] = p;
      else
        others.push_back(p);
    }
    if (!vectors[0] || !vectors[1] || !vectors[2]) fail("its vertices have no x, y, z");
    const bool normals = vectors[3] && vectors[4] && vectors[5];
    for (const std::size_t p : others) mesh_.columns.push_back({element.properties[p].name, "", 1, {}});
    std::vector<double> row(element.properties.size());
    for (std::size_t i = 0; i < element.count; ++i) {
      for (std::size_t p = 0; p < row.size(); ++p) row[p] = next(*element.properties[p].type);
      const auto vector = [&](std::size_t first) {
        return Vec3(row[*vectors[first]], row[*vectors[first + 1]], row[*vectors[first + 2]]);
      };
      mesh_.points.push_back(vector(0));
      if (!mesh_.points.back().allFinite()) fail("vertex " + std::to_string(i) + " is not finite");
      if (normals) mesh_.normals.push_back(vector(3));
      for (std::size_t c = 0; c < others.size(); ++c) mesh_.columns[c].values.push_back(row[others[c]]);
    }
  }

  void read_faces(const Element& element) {
    for (std::size_t f = 0; f < element.count; ++f)
      for (const Property& p : element.properties) {
        if (!p.count) {
          static_cast<void>(next(*p.type));
          continue;
        }
        const double corners = next(*p.count);
        if (corners != 3.0)
          fail("face " + std::to_string(f) + " has " + std::to_string(std::lround(corners)) +
               " corners, must have 3");
        std::array<std::uint32_t, 3> triangle{};
        for (std::uint32_t& i : triangle) {
          const double index = next(*p.type);
          if (!(index >= 0.0 && index < static_cast<double>(mesh_.points.size())))
            fail("face " + std::to_string(f) + " names no vertex");
          i = static_cast<std::uint32_t>(index);
        }
        mesh_.triangles.push_back(triangle);
      }
  }

  const std::filesystem::path& file_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::vector<Element> elements_;
  TriMesh mesh_;
};

}  // namespace

void write_ply(const std::filesystem::path& file, const TriMesh& mesh) {
  require_consistent(mesh);
  std::string bytes = header_of(mesh);
  std::size_t numbers = mesh.normals.empty() ? 3 : 6;
  for (const Column& c : mesh.columns) numbers += static_cast<std::size_t>(c.components);
  bytes.reserve(bytes.size() + mesh.points.size() * numbers * sizeof(double) + mesh.triangles.size() * 13);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    for (int k = 0; k < 3; ++k) append(bytes, mesh.points[i][k]);
    if (!mesh.normals.empty())
      for (int k = 0; k < 3; ++k) append(bytes, mesh.normals[i][k]);
    for (const Column& c : mesh.columns) {
      const auto n = static_cast<std::size_t>(c.components);
      for (std::size_t k = 0; k < n; ++k) append(bytes, c.values[i * n + k]);
    }
  }
  for (const auto& t : mesh.triangles) {
    append(bytes, std::uint8_t{3});
    for (const std::uint32_t i : t) append(bytes, i);
  }
  write_text_file(file, bytes);
}

TriMesh read_ply(const std::filesystem::path& file) {
  const std::string bytes = read_text_file(file, largest_mesh_file);
  return PlyReader(file, bytes).read();
}

}  // namespace blendwright
