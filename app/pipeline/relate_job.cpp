#include "app/pipeline/relate_job.hpp"

#include <cmath>

#include "kernel/base/number_text.hpp"

namespace blendwright {

std::vector<RelationStatement> statements(const SetRelation& r, std::span<const Body> bodies) {
  const std::string &a = bodies[0].name, &b = bodies[1].name;
  return {{a + " is empty", r.first_empty},
          {b + " is empty", r.second_empty},
          {"no point is in both", r.apart},
          {a + " is inside " + b, r.first_in_second},
          {b + " is inside " + a, r.second_in_first}};
}

std::string relation_text(const SetRelation& relation, std::span<const Body> bodies) {
  using Kind = SetRelation::Kind;
  const std::string &a = bodies[0].name, &b = bodies[1].name;
  switch (relation.kind) {
    case Kind::disjoint:
      return a + " and " + b + " are disjoint";
    case Kind::first_inside_second:
      return a + " is inside " + b;
    case Kind::second_inside_first:
      return b + " is inside " + a;
    case Kind::overlapping:
      return a + " and " + b + " overlap";
    case Kind::undecided:
      break;
  }
  return "undecided";
}

std::string membership_header(std::size_t solids) {
  std::string text = "x,y,z";
  for (std::size_t i = 0; i < solids; ++i)
    for (const char* column : {"s2", "s3", "phi", "distance"}) {
      text.append(1, ',').append(column);
      if (solids > 1) text.append(1, '_').append(1, static_cast<char>('a' + i));
    }
  return text += '\n';
}

std::string membership_lines(std::span<const Vec3> points,
                             std::span<const std::vector<Membership>> of_solids) {
  std::string text;
  const auto add = [&](double x) {
    text += ',';
    if (std::isfinite(x)) text += number_text(x + 0.0);  // no -0
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    text += number_text(points[i].x() + 0.0);
    add(points[i].y());
    add(points[i].z());
    for (const std::vector<Membership>& of : of_solids) {
      const Membership& m = of[i];
      text.append(m.belongs ? ",1," : ",0,").append(std::to_string(static_cast<int>(m.place)));
      add(m.phi);
      add(m.distance);
    }
    text += '\n';
  }
  return text;
}

}  // namespace blendwright
