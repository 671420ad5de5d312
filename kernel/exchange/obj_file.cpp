// Wavefront OBJ: "v x y z", "vn x y z", "g name", "f a//a b//b c//c" with indices from 1 that run over the
// whole file.
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/text_file.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "kernel/exchange/mesh_formats.hpp"

namespace blendwright {
namespace {

std::string group_name(const std::string& name, std::size_t index) {
  std::string word = name.empty() ? "mesh_" + std::to_string(index) : name;
  for (char& c : word)
    if (static_cast<unsigned char>(c) <= ' ') c = '_';  // a blank would start a second group
  return word;
}

void append_vector(std::string& text, const char* key, const Vec3& p) {
  text += key;
  for (int k = 0; k < 3; ++k) text += ' ' + number_text(p[k]);
  text += '\n';
}

void append_mesh(std::string& text, const TriMesh& mesh, std::size_t first_point, std::size_t first_normal) {
  for (const Vec3& p : mesh.points) append_vector(text, "v", p);
  for (const Vec3& n : mesh.normals) append_vector(text, "vn", n);
  for (const auto& triangle : mesh.triangles) {
    text += 'f';
    for (const std::uint32_t i : triangle) {
      text += ' ' + std::to_string(first_point + i);
      if (!mesh.normals.empty()) text += "//" + std::to_string(first_normal + i);
    }
    text += '\n';
  }
}

/// Words of one line.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}
  std::string_view next() {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t begin = rest_.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    const std::size_t end = std::min(rest_.find_first_of(blanks, begin), rest_.size());
    const std::string_view word = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    return word;
  }

 private:
  std::string_view rest_;
};

template <class Number>
std::optional<Number> parse(std::string_view word) {
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// Index of a face's corner: from 1, or negative from the end.
std::optional<std::uint32_t> parse_index(std::string_view word, std::size_t count) {
  const auto i = parse<std::int64_t>(word);
  const auto n = static_cast<std::int64_t>(count);
  if (!i || *i == 0 || *i > n || *i < -n) return std::nullopt;
  return static_cast<std::uint32_t>(*i > 0 ? *i - 1 : n + *i);
}

class ObjReader {
 public:
  explicit ObjReader(const std::filesystem::path& file) : file_(file) { mesh_.name = file.stem().string(); }

  void read_line(std::string_view line) {
    ++line_;
    Words words(line);
    const std::string_view key = words.next();
    if (key == "v") mesh_.points.push_back(vector(words));
    if (key == "vn") normals_.push_back(vector(words));
    if (key == "f") face(words);
  }

  /// Normals are kept when each point has been used with one normal only.
  TriMesh finish() {
    mesh_.normals.assign(mesh_.points.size(), Vec3::Zero());
    for (std::size_t i = 0; i < normal_of_.size(); ++i)
      if (normal_of_[i]) mesh_.normals[i] = normals_[*normal_of_[i]];
    if (!one_normal_each_ || normals_.empty()) mesh_.normals.clear();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    fail_reading(file_, "line " + std::to_string(line_) + ": " + why);
  }

  Vec3 vector(Words& words) const {
    Vec3 p;
    for (int k = 0; k < 3; ++k) {
      const auto x = parse<double>(words.next());
      if (!x || !std::isfinite(*x)) fail("must have three finite numbers");
      p[k] = *x;
    }
    return p;
  }

  /// "a", "a/t", "a//n" or "a/t/n".
  std::uint32_t corner(std::string_view word) {
    const std::size_t slash = word.find('/');
    const auto point = parse_index(word.substr(0, slash), mesh_.points.size());
    if (!point) fail("\"" + std::string(word) + "\" names no point");
    normal_of_.resize(mesh_.points.size());
    const std::size_t last = word.rfind('/');
    const bool has_normal = slash != std::string_view::npos && last != slash;
    std::optional<std::uint32_t> normal;
    if (has_normal) {
      normal = parse_index(word.substr(last + 1), normals_.size());
      if (!normal) fail("\"" + std::string(word) + "\" names no normal");
    }
    if (normal_of_[*point] && normal_of_[*point] != normal) one_normal_each_ = false;
    if (!normal) one_normal_each_ = false;
    normal_of_[*point] = normal;
    return *point;
  }

  void face(Words& words) {
    std::array<std::uint32_t, 3> triangle{};
    std::size_t corners = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++corners)
      if (corners < 3) triangle[corners] = corner(word);
    if (corners != 3) fail("the face has " + std::to_string(corners) + " corners, must have 3");
    mesh_.triangles.push_back(triangle);
  }

  const std::filesystem::path& file_;
  TriMesh mesh_;
  std::vector<Vec3> normals_;
  std::vector<std::optional<std::uint32_t>> normal_of_;
  bool one_normal_each_ = true;
  std::size_t line_ = 0;
};

}  // namespace

void write_obj(const std::filesystem::path& file, std::span<const TriMesh> meshes) {
  std::string text = "# written by blendwright\n";
  std::size_t point = 1, normal = 1;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    require_consistent(meshes[m]);
    if (!meshes[m].note.empty()) text += "# " + meshes[m].note + '\n';
    text += "g " + group_name(meshes[m].name, m) + '\n';
    append_mesh(text, meshes[m], point, normal);
    point += meshes[m].points.size();
    normal += meshes[m].normals.size();
  }
  write_text_file(file, text);
}

TriMesh read_obj(const std::filesystem::path& file) {
  const std::string text = read_text_file(file, largest_mesh_file);
  ObjReader reader(file);
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    reader.read_line(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return reader.finish();
}

}  // namespace blendwright
