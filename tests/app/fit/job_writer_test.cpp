// A job's text with other values: read back, it is the changed job to the last bit; the rest of it stays.
#include "app/json/job_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "app/json/job_reader.hpp"
#include "kernel/base/text_file.hpp"
#include "tests/app/job_support.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

using testing::HasSubstr;

// --- equality to the last bit ----------------------------------------------------------------------------

bool same(const std::vector<LawPoint>& a, const std::vector<LawPoint>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const LawPoint& p, const LawPoint& q) { return p.t == q.t && p.value == q.value; });
}
bool same(const SideSpec& a, const SideSpec& b) {
  return a.continuity == b.continuity && a.rule == b.rule && same(a.factor, b.factor) &&
         a.tangent_angle == b.tangent_angle && a.keep == b.keep;
}
bool same(const CurveSpec& a, const CurveSpec& b) {
  return a.formulas == b.formulas && a.points == b.points && a.closed == b.closed &&
         (a.formulas.empty() || a.v == b.v);
}
bool same(const TrimlineSpec& a, const TrimlineSpec& b) {
  const bool iso = a.kind == TrimlineSpec::Kind::isoline;
  return a.kind == b.kind &&
         (!iso || (a.direction == b.direction && a.value == b.value && a.range == b.range)) &&
         same(a.curve, b.curve) && a.along == b.along && a.edge.near == b.edge.near &&
         a.edge.curve == b.edge.curve && a.shift == b.shift;
}
template <class T, class Same>
bool same(const std::optional<T>& a, const std::optional<T>& b, Same both) {
  return a.has_value() == b.has_value() && (!a || both(*a, *b));
}
bool same(const BlendSideEntry& a, const BlendSideEntry& b) {
  const auto lines = [](const TrimlineSpec& s, const TrimlineSpec& t) { return same(s, t); };
  const auto literals = [](const LiteralEnd& s, const LiteralEnd& t) {
    return s.C == t.C && s.T == t.T && s.D == t.D;
  };
  return a.primary == b.primary && same(a.trimline, b.trimline, lines) &&
         same(a.literal, b.literal, literals) && same(a.side, b.side);
}
bool same(const BlendShape& a, const BlendShape& b) {
  return a.mode == b.mode && a.anchor == b.anchor && a.ode == b.ode && a.repeated_root == b.repeated_root &&
         a.family == b.family && a.tension == b.tension && a.frame == b.frame && a.axes == b.axes;
}
bool same(const BlendEntry& a, const BlendEntry& b) {
  const auto ranges = [](const CurveDomain& s, const CurveDomain& t) {
    return s.v == t.v && s.closed == t.closed;
  };
  const CorrespondenceSpec &c = a.correspondence, &d = b.correspondence;
  return a.name == b.name && same(a.sides[0], b.sides[0]) && same(a.sides[1], b.sides[1]) &&
         same(a.shape, b.shape) && c.rule == d.rule && c.reverse == d.reverse &&
         c.seam_offset == d.seam_offset && same(c.map, d.map) && same(a.v, b.v, ranges);
}

// --- random changes --------------------------------------------------------------------------------------

template <class E>
E one_of(Rng& rng, std::initializer_list<E> all) {
  return all.begin()[integer(rng, 0, static_cast<int>(all.size()) - 1)];
}
double any_number(Rng& rng) {
  return integer(rng, 0, 4) == 0 ? integer(rng, -5, 5) : uniform(rng, -10.0, 10.0);
}

void change_factor(SideSpec& side, Rng& rng) {
  side.factor = {{0.0, log_uniform(rng, 0.05, 5.0)}};
  const int points = integer(rng, 1, 8);
  if (points == 1) return;
  side.factor.clear();
  for (int i = 0; i < points; ++i)
    side.factor.push_back({(i + uniform(rng, 0.0, 0.9)) / points, log_uniform(rng, 0.05, 5.0)});
}

void change_side(BlendSideEntry& entry, Rng& rng) {
  SideSpec& side = entry.side;
  switch (integer(rng, 0, 4)) {
    case 0:
      side.rule = one_of(rng, {MagnitudeRule::chord, MagnitudeRule::circle_like, MagnitudeRule::arc_length,
                               MagnitudeRule::minimum_bending, MagnitudeRule::constant});
      break;
    case 1:
      change_factor(side, rng);
      break;
    case 2:
      side.tangent_angle = Radians(uniform(rng, -1.04, 1.04));
      break;
    case 3:
      side.keep = one_of(rng, {SideSpec::Keep::automatic, SideSpec::Keep::left, SideSpec::Keep::right});
      break;
    default:
      side.continuity = one_of(rng, {Continuity::G0, Continuity::G1, Continuity::G2});
  }
}

void change_trimline(TrimlineSpec& line, Rng& rng) {
  if (integer(rng, 0, 1) == 0) {
    line.shift.clear();
    const int points = integer(rng, 0, 8);
    for (int i = 0; i < points; ++i)
      line.shift.push_back({(i + uniform(rng, 0.0, 0.9)) / points, Vec2(any_number(rng), any_number(rng))});
  }
  if (line.kind == TrimlineSpec::Kind::isoline) {
    line.value = any_number(rng);
    if (integer(rng, 0, 2) == 0) {
      const double lo = any_number(rng);
      line.range = Interval{lo, lo + uniform(rng, 0.1, 3.0)};
    }
  }
  for (Vec3& p : line.curve.points)
    if (integer(rng, 0, 1) == 0) p[integer(rng, 0, 1)] = any_number(rng);
  if (line.kind == TrimlineSpec::Kind::parameters && integer(rng, 0, 2) == 0) {
    line.curve = {};
    line.curve.closed = integer(rng, 0, 1) == 0;
    for (int i = 0; i < integer(rng, 4, 40); ++i)
      line.curve.points.emplace_back(any_number(rng), any_number(rng), 0.0);
  }
  if (line.kind == TrimlineSpec::Kind::projected && integer(rng, 0, 2) == 0)
    line.along =
        integer(rng, 0, 1) == 0 ? std::nullopt : std::optional(Vec3(1.0, any_number(rng), any_number(rng)));
}

void change_shape(BlendShape& shape, bool sixth, Rng& rng) {
  shape.mode = one_of(rng, {BlendMode::chord, BlendMode::origin, BlendMode::anchor});
  shape.anchor = Vec3::Zero();
  if (shape.mode == BlendMode::anchor) shape.anchor = Vec3(any_number(rng), any_number(rng), any_number(rng));
  shape.family = SixthOrderFamily::tension1;
  shape.frame = BlendFrame::global;
  shape.axes = Eigen::Matrix3d::Identity();
  shape.repeated_root.reset();
  shape.tension = integer(rng, 0, 3) == 0 ? 0.0 : log_uniform(rng, 1e-3, 50.0);
  if (sixth)
    shape.family = one_of(rng, {SixthOrderFamily::tension1, SixthOrderFamily::tension2,
                                SixthOrderFamily::triple, SixthOrderFamily::quintic});
  if (shape.family == SixthOrderFamily::quintic) shape.tension = 0.0;
  shape.ode.fill(SweepOde::tension(shape.tension));
  if (sixth) return;
  shape.frame = one_of(rng, {BlendFrame::global, BlendFrame::moving, BlendFrame::fixed});
  if (shape.frame == BlendFrame::fixed)
    shape.axes = Eigen::AngleAxisd(uniform(rng, -3.0, 3.0), Vec3(1.0, any_number(rng), 2.0).normalized())
                     .toRotationMatrix();
  const int form = integer(rng, 0, 3);
  if (form == 0) return;
  shape.tension = 0.0;
  shape.ode.fill(SweepOde{});
  if (form == 1) shape.repeated_root = log_uniform(rng, 1e-3, 50.0);
  if (form == 2) shape.ode.fill({any_number(rng) + 20.0, any_number(rng), any_number(rng)});
  if (form == 3)
    for (SweepOde& o : shape.ode) o = SweepOde::tension(log_uniform(rng, 1e-3, 50.0));
}

void change_correspondence(CorrespondenceSpec& c, Rng& rng) {
  c.rule = one_of(
      rng, {CorrespondenceRule::arc_length, CorrespondenceRule::as_given, CorrespondenceRule::minimal_twist});
  c.reverse = one_of<std::optional<bool>>(rng, {std::nullopt, true, false});
  c.seam_offset = integer(rng, 0, 1) == 0 ? std::nullopt : std::optional(uniform(rng, 0.0, 1.0));
}

bool sixth(const BlendEntry& blend) {
  return blend.sides[0].side.continuity == Continuity::G2 || blend.sides[1].side.continuity == Continuity::G2;
}

void change(BlendEntry& blend, Rng& rng) {
  const bool was = sixth(blend);
  for (BlendSideEntry& side : blend.sides) {
    if (integer(rng, 0, 1) == 0 && !blend.literal()) change_side(side, rng);
    if (integer(rng, 0, 1) == 0 && side.trimline) change_trimline(*side.trimline, rng);
  }
  // What has no effect on the other order cannot stand in a job.
  if (integer(rng, 0, 1) == 0 || was != sixth(blend)) change_shape(blend.shape, sixth(blend), rng);
  if (integer(rng, 0, 1) == 0 && !blend.literal()) change_correspondence(blend.correspondence, rng);
}

std::vector<std::string> comments(const std::string& text) {
  std::vector<std::string> all;
  for (std::size_t at = 0; (at = text.find("//", at)) != std::string::npos;) {
    const std::size_t end = text.find('\n', at);
    all.push_back(text.substr(at, end - at));
    at = end;
  }
  return all;
}

std::string reordered(const std::string& spec) {  // a job that has more than the examples
  return R"({ "primaries": { "ball": { "kind": "sphere", "radius": 2 },
  "net": { "kind": "plane", "x": [-9, 9], "y": [-9, 9] } },
  "blends": { )" +
         spec + " } }";
}

std::vector<std::pair<std::string, std::string>> texts() {
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& file : std::filesystem::directory_iterator(specs_folder()))
    if (file.path().extension() == ".json")
      all.emplace_back(file.path().stem().string(), read_text_file(file.path(), std::size_t{1} << 24));
  std::sort(all.begin(), all.end());
  all.emplace_back("points", reordered(R"("a": { // first
      "from": { "primary": "net", // the net
        "trimline": { "kind": "parameters", "points": [[1, 0],
             [0, 1], [-1, 0],
             [0, -1], [1, 0]] } },
      "to": { "primary": "ball", "trimline": { "kind": "isoline", "latitude_deg": 45 }, "tangent_angle_deg": 10 },
      "shape": { "c": [-1, -2, "-3"], "frame": { "fixed": [[0, 1, 0], [0, 0, 1], [1, 0, 0]] } } // last
    },
    "b": { "from": { "primary": "net", "trimline": { "kind": "isoline", "x": 1, "range": [0, 1] } },
           "to": { "primary": "ball", "trimline": { "kind": "isoline", "latitude_deg": 30, "range_deg": [0, 90] },
                   "magnitude": { "factor": [[0, 1], [0.5, 2]] } },
           "correspondence": { "reverse": true } })"));
  return all;
}

TEST(JobWriter, KeepsTheTextWhenNothingChanged) {
  for (const auto& [name, text] : texts())
    EXPECT_EQ(job_text(text, read_job(text, name + ".json")), text) << name;
}

TEST(JobWriter, WritesWhatIsReadBackToTheLastBit) {
  const auto all = texts();
  ASSERT_GE(all.size(), 10u);
  int written = 0, radians = 0;
  for_all(
      [&](Rng& rng) {
        const auto& [name, text] =
            all[static_cast<std::size_t>(integer(rng, 0, static_cast<int>(all.size()) - 1))];
        JobSpec job = read_job(text, name + ".json");
        for (BlendEntry& blend : job.blends) change(blend, rng);
        const std::string after = job_text(text, job);
        const JobSpec read = read_job(after, name + ".json");
        for (std::size_t i = 0; i < job.blends.size(); ++i)
          EXPECT_TRUE(same(read.blends[i], job.blends[i])) << name << ", blend " << i << "\n" << after;
        EXPECT_EQ(comments(after), comments(text)) << after;
        EXPECT_EQ(after.substr(0, after.find("\"blends\"")), text.substr(0, text.find("\"blends\"")));
        EXPECT_EQ(job_text(after, job), after);
        written += after != text;
        radians += after.find("_rad") != std::string::npos;
      },
      600);
  EXPECT_GT(written, 300);
  EXPECT_GT(radians, 5);  // angles that no number of degrees stands for occur
}

TEST(JobWriter, WritesAsAPersonWould) {
  const std::string text = read_text_file(specs_folder() / "branch-to-main.json", std::size_t{1} << 20);
  JobSpec job = read_job(text, "branch-to-main.json");
  BlendEntry& blend = job.blends[0];
  blend.shape.tension = 2.5;
  blend.sides[0].side.factor = {{0.0, 1.25}};
  blend.sides[1].side.tangent_angle = degrees(15.0);
  blend.sides[1].side.factor = {{0.0, 1.0}, {0.5, 1.4}};
  const std::string after = job_text(text, job);
  EXPECT_THAT(after, HasSubstr("\"shape\": { \"tension\": 2.5 }"));
  EXPECT_THAT(after,
              HasSubstr("\"continuity\": \"G2\",\n                \"magnitude\": { \"factor\": 1.25 } },\n"));
  EXPECT_THAT(after, HasSubstr("\n                \"magnitude\": { \"factor\": [[0, 1], [0.5, 1.4]] },\n"
                               "                \"tangent_angle_deg\": 15 },\n"));
}

TEST(JobWriter, SaysCommonAngleInShortDegrees) {
  const std::string text =
      reordered(R"("a": { "from": { "primary": "net", "trimline": { "kind": "isoline", "x": 0 } },
      "to": { "primary": "ball", "trimline": { "kind": "isoline", "latitude_deg": 45 } } })");
  JobSpec job = read_job(text, "a.json");
  for (int d = -85; d <= 85; d += 5) {
    job.blends[0].sides[1].trimline->value = degrees(d).value;
    EXPECT_THAT(job_text(text, job), HasSubstr("\"latitude_deg\": " + std::to_string(d) + " }"));
  }
}

TEST(JobWriter, RefusesWhatAJobCannotHold) {
  const std::string text = read_text_file(specs_folder() / "branch-to-main.json", std::size_t{1} << 20);
  const JobSpec job = read_job(text, "branch-to-main.json");
  const auto where = [&](const JobSpec& changed) {
    try {
      return job_text(text, changed);
    } catch (const InputError& e) {
      return e.problems().at(0).where;
    }
  };
  JobSpec zero = job, steep = job, none = job, other = job;
  zero.blends[0].sides[0].side.factor = {{0.0, 0.0}};
  EXPECT_EQ(where(zero), "/blends/fillet/from/magnitude/factor");
  steep.blends[0].sides[1].side.tangent_angle = degrees(61.0);
  EXPECT_EQ(where(steep), "/blends/fillet/to/tangent_angle_deg");
  none.blends[0].shape.tension = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(where(none), "/blends/fillet/shape/tension");
  other.blends[0].name = "other";
  EXPECT_THROW(static_cast<void>(job_text(text, other)), std::logic_error);
  other.blends.clear();
  EXPECT_THROW(static_cast<void>(job_text(text, other)), std::logic_error);
  EXPECT_THROW(static_cast<void>(job_text("{", job)), InputError);
}

}  // namespace
}  // namespace blendwright::test
