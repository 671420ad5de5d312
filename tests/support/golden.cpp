#include "tests/support/golden.hpp"

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace blendwright::test {
namespace {

using Json = nlohmann::json;

/// Every key must be known, and every one that is known must be there.
void require_keys(const Json& object, std::initializer_list<const char*> keys, const std::string& where) {
  for (const char* key : keys)
    if (!object.contains(key)) throw std::runtime_error(where + " has no key " + key);
  for (const auto& [key, value] : object.items())
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      throw std::runtime_error(where + " has the unknown key " + key);
}

Table table(const Json& rows, std::size_t count, std::size_t columns, const std::string& where) {
  Table t = rows.get<Table>();
  if (t.size() != count) throw std::runtime_error(where + " has the wrong number of rows");
  for (const auto& row : t)
    if (row.size() != columns) throw std::runtime_error(where + " has a row of the wrong length");
  return t;
}

std::array<Table, 4> derivatives(const Json& c, std::size_t count, std::size_t columns,
                                 const std::string& where) {
  return {table(c["phi"], count, columns, where), table(c["d1"], count, columns, where),
          table(c["d2"], count, columns, where), table(c["d3"], count, columns, where)};
}

std::vector<Vec3> points(const Json& rows, std::size_t count, const std::string& where) {
  std::vector<Vec3> result;
  for (const auto& row : table(rows, count, 3, where)) result.emplace_back(row[0], row[1], row[2]);
  return result;
}

CardinalCase cardinal(const Json& c, const std::string& where) {
  CardinalCase r;
  const std::string input = c.at("input");
  r.by_root = input == "q";
  if (r.by_root) {
    require_keys(c, {"input", "q", "regime", "u", "phi", "d1", "d2", "d3"}, where);
    r.q = c["q"];
  } else if (input == "bcd") {
    require_keys(c, {"input", "b", "c", "d", "regime", "u", "phi", "d1", "d2", "d3"}, where);
    r.ode = {c["b"], c["c"], c["d"]};
  } else {
    throw std::runtime_error(where + " has the unknown input " + input);
  }
  r.label = where + (r.by_root ? " q = " + c["q"].dump()
                               : " (" + c["b"].dump() + ", " + c["c"].dump() + ", " + c["d"].dump() + ")");
  r.regime = c["regime"];
  r.u = c["u"].get<std::vector<double>>();
  r.derivative = derivatives(c, r.u.size(), 4, where);
  return r;
}

SixthOrderCase sixth_order(const Json& c, const std::string& where) {
  require_keys(c, {"kind", "q", "u", "order", "phi", "d1", "d2", "d3"}, where);
  if (c["order"] != Json({"pos0", "d0", "dd0", "pos1", "d1", "dd1"}))
    throw std::runtime_error(where + " has an unknown order of columns");
  SixthOrderCase r{.kind = c["kind"], .q = c["q"], .u = c["u"].get<std::vector<double>>(), .derivative = {}};
  r.derivative = derivatives(c, r.u.size(), 6, where);
  return r;
}

PointGrid grid(const Json& rows, std::size_t nu, std::size_t nv, const std::string& where) {
  if (rows.size() != nu) throw std::runtime_error(where + " has the wrong number of rows");
  PointGrid g;
  for (const Json& row : rows) g.push_back(points(row, nv, where));
  return g;
}

ExampleSide side(const Json& s, const std::string& where) {
  require_keys(s,
               {"max_pos_err", "max_tangent_out_of_plane_rad", "min_sin_tangent_vs_trimline",
                "printed_tangent_max_normal_angle_deg", "printed_equals_corrected"},
               where);
  return {s["max_pos_err"], s["max_tangent_out_of_plane_rad"], s["min_sin_tangent_vs_trimline"]};
}

std::map<std::string, std::vector<Vec3>> boundary(const Json& b, std::size_t nv, const std::string& where) {
  require_keys(b, {"C0", "T0", "C1", "T1"}, where);
  std::map<std::string, std::vector<Vec3>> r;
  for (const auto& [key, value] : b.items()) r[key] = points(value, nv, where);
  return r;
}

ExampleCase example(const Json& e, const std::string& where) {
  require_keys(e,
               {"id", "title", "constants", "v_range", "closed", "note", "u", "v", "s0", "s1", "boundary",
                "boundary_dv", "surfaces", "checks"},
               where);
  ExampleCase r;
  r.id = e["id"];
  r.constants = e["constants"].get<std::map<std::string, double>>();
  r.v_range = {e["v_range"].at(0), e["v_range"].at(1)};
  r.closed = e["closed"];
  r.u = e["u"].get<std::vector<double>>();
  r.v = e["v"].get<std::vector<double>>();
  r.s = {e["s0"], e["s1"]};
  r.boundary = boundary(e["boundary"], r.v.size(), where + ".boundary");
  r.boundary_dv = boundary(e["boundary_dv"], r.v.size(), where + ".boundary_dv");
  for (const Json& s : e["surfaces"]) {
    require_keys(s, {"ode", "b", "c", "d", "regime", "mode", "S", "Su", "Sv", "Suu"}, where + ".surfaces");
    const auto values = [&](const char* key) {
      return grid(s[key], r.u.size(), r.v.size(), where + "." + key);
    };
    r.surfaces.push_back({s["ode"], s["regime"], s["mode"], SweepOde{s["b"], s["c"], s["d"]}, values("S"),
                          values("Su"), values("Sv"), values("Suu")});
  }
  require_keys(e["checks"], {"side0", "side1"}, where + ".checks");
  r.sides = {side(e["checks"]["side0"], where + ".side0"), side(e["checks"]["side1"], where + ".side1")};
  return r;
}

constexpr std::array<const char*, 6> sections{"meta",      "cardinal", "resonances",
                                              "cardinal6", "examples", "spans"};

/// Files of the other schemas name theirs.
bool is_sweep_file(const Json& file, const std::string& where) {
  const bool ours = std::any_of(sections.begin(), sections.end(), [&](const char* key) {
    return std::string(key) != "meta" && file.contains(key);
  });
  if (ours) return true;
  if (!file.contains("schema")) throw std::runtime_error(where + " is of an unknown schema");
  return false;
}

void append(const Json& file, const std::string& where, SweepGolden& all) {
  for (const auto& [key, value] : file.items())
    if (std::find(sections.begin(), sections.end(), key) == sections.end() && key != "schema")
      throw std::runtime_error(where + " has the unknown key " + key);
  const Json none = Json::array();
  const auto list = [&](const char* key) -> const Json& { return file.contains(key) ? file[key] : none; };
  const auto place = [&](const char* key, std::size_t i) {
    return where + " " + key + "[" + std::to_string(i) + "]";
  };
  for (std::size_t i = 0; i < list("cardinal").size(); ++i)
    all.cardinal.push_back(cardinal(file["cardinal"][i], place("cardinal", i)));
  for (std::size_t i = 0; i < list("cardinal6").size(); ++i)
    all.sixth_order.push_back(sixth_order(file["cardinal6"][i], place("cardinal6", i)));
  for (std::size_t i = 0; i < list("examples").size(); ++i)
    all.examples.push_back(example(file["examples"][i], place("examples", i)));
  for (const auto& [key, values] : list("resonances").items()) {
    std::vector<double>& modes = all.resonances[key];
    for (const Json& x : values) modes.push_back(x);
  }
}

}  // namespace

SweepGolden read_sweep_golden(const std::filesystem::path& folder) {
  SweepGolden all;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& path : files) {
    const std::string where = path.filename().string();
    try {
      std::ifstream in(path);
      const Json file = Json::parse(in);
      if (is_sweep_file(file, where)) append(file, where, all);
    } catch (const Json::exception& e) {
      throw std::runtime_error(where + ": " + e.what());
    }
  }
  return all;
}

}  // namespace blendwright::test
