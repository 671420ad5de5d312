// A blend in chord mode belongs to the part: it does not depend on where the part lies, how large it is,
// which side is named first, or where and in which direction a trimline starts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/pipeline/build_primaries.hpp"
#include "kernel/geometry/project.hpp"
#include "tests/app/changed_jobs.hpp"
#include "tests/app/job_support.hpp"
#include "tests/parametric/random_blend.hpp"

namespace blendwright {
namespace {

using namespace test;
using std::numbers::pi;

/// A wavy line on a torus, and an ellipse on a free surface above it.
JobSpec torus_to_roof() {
  JobSpec job;
  job.name = "torus-to-roof";
  PrimarySpec torus{.kind = "torus", .numbers = {{"major_radius", 3.0}, {"minor_radius", 1.0}}};
  PrimarySpec roof{.kind = "formula", .formulas = {"u", "v", "3 + 0.1*u^2 - 0.05*u*v + 0.2*sin(v)"}};
  roof.u = roof.v = Interval{-3.0, 3.0};
  job.primaries = {{"torus", torus}, {"roof", roof}};
  const auto typed = [](const char* u, const char* v) {
    TrimlineSpec line;
    line.kind = TrimlineSpec::Kind::parameters;
    line.curve = {{u, v}, {}, true, {0.0, 2.0 * pi}};
    return line;
  };
  BlendEntry blend{.name = "cap"};
  blend.sides[0].primary = "torus";
  blend.sides[0].trimline = typed("1.4 + 0.2*sin(2*v)", "v + 0.1*cos(v)");
  blend.sides[1].primary = "roof";
  blend.sides[1].trimline = typed("0.1 + 1.5*cos(v)", "0.2 + 1.2*sin(v)");
  blend.sides[1].side.tangent_angle = degrees(20.0);
  blend.sides[0].side.keep = SideSpec::Keep::left;  // the outer part of the torus
  blend.sides[1].side.keep = SideSpec::Keep::left;  // the inner part of the roof
  job.blends = {blend};
  return job;
}

/// The joint with `continuity` on both sides and one sweep equation for all components, none of whose
/// solutions is linear in u: what keeps the blend in place is the mode alone.
JobSpec isotropic(JobSpec job, Continuity continuity) {
  for (BlendEntry& blend : job.blends) {
    for (BlendSideEntry& side : blend.sides) side.side.continuity = continuity;
    blend.shape = {};
    blend.shape.ode.fill({1.0, -5.0, 6.25});
    blend.shape.family = SixthOrderFamily::triple;
    blend.shape.tension = 1.5;
  }
  return job;
}

std::vector<JobSpec> joints(const std::vector<const char*>& examples) {
  std::vector<JobSpec> jobs;
  for (const Continuity continuity : {Continuity::G1, Continuity::G2}) {
    for (const char* name : examples) jobs.push_back(isotropic(example_job(name), continuity));
    jobs.push_back(isotropic(torus_to_roof(), continuity));
  }
  return jobs;
}

template <class Property>
void for_each_joint(const std::vector<const char*>& examples, Property property) {
  for (const JobSpec& job : joints(examples)) {
    SCOPED_TRACE(job.name + " " + name(job.blends[0].sides[0].side.continuity));
    property(job);
  }
}

/// Where a point (u, v) of one blend lies on another: u or 1 - u, start + sign v.
struct Match {
  bool u_reversed = false;
  double start = 0.0, sign = 1.0;
  [[nodiscard]] UV operator()(UV p, const SurfaceDomain& domain) const {
    double v = start + sign * p.v;
    if (domain.v_closed) v -= domain.v.length() * std::floor((v - domain.v.lo) / domain.v.length());
    return {u_reversed ? 1.0 - p.u : p.u, v};
  }
};

const OdeBlend& exact(const JobResult& result) { return result.blends.at(0).blend.surface; }
const OdeBlend& exact(const Blend& blend) { return blend.surface; }

/// The exact blend of a job alone, without fit and verdict.
Blend blend_of(const JobSpec& job) {
  const BlendEntry& entry = job.blends.at(0);
  const auto primaries = build_primaries(job);
  const auto line = [&](std::size_t side) {
    for (const BuiltPrimary& p : primaries)
      if (p.name == entry.sides[side].primary)
        return build_trimline(*entry.sides[side].trimline, p, job.constants, "").line;
    throw std::logic_error("no primary " + entry.sides[side].primary);
  };
  const BlendSpec spec{{entry.sides[0].side, entry.sides[1].side}, entry.correspondence, entry.shape};
  return make_blend(line(0), line(1), spec, job.tolerance.position);
}

double size_of(const OdeBlend& blend) {
  Eigen::AlignedBox3d box;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 32; ++j) box.extend(blend.jet({0.25 * i, blend.domain().v.at(j / 32.0)}).S);
  return box.diagonal().norm();
}

/// Largest |b - change(a)| over the blend, relative to the size of b.
template <class Change>
double difference(const OdeBlend& a, const OdeBlend& b, Change change, const Match& match = {}) {
  double worst = 0.0;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 60; ++j) {
      const UV p{0.1 * i, a.domain().v.at(j / 60.0)};
      worst = std::max(worst, (b.jet(match(p, b.domain())).S - change(a.jet(p).S)).norm());
    }
  return worst / size_of(b);
}

RigidMotion random_motion(Rng& rng, double reach) {
  return {random_rotation(rng), random_vector(rng, reach)};
}

constexpr auto same = [](const Vec3& x) { return x; };

TEST(Invariance, BlendMovesWithThePart) {
  for_each_joint({"branch-to-main", "leaning-cylinder", "open-blend", "step-transition"},
                 [](const JobSpec& job) {
                   const JobResult still = run_job(job);
                   const double size = size_of(exact(still));
                   for_all(
                       [&](Rng& rng) {
                         // Coordinates up to 20 sizes: their rounding is 5e-15 of the size.
                         const RigidMotion motion = random_motion(rng, 10.0 * size);
                         const JobResult other = run_job(moved(job, motion));
                         EXPECT_LE(difference(exact(still), exact(other), motion), 1e-11);
                         EXPECT_TRUE(verified(other));
                       },
                       4);
                 });
}

TEST(Invariance, BlendInItsOwnFrameMovesWithThePartWhateverTheEquations) {
  JobSpec job = isotropic(example_job("leaning-cylinder"), Continuity::G1);
  job.blends[0].shape.ode = {SweepOde{1, -3, 2}, SweepOde{1, -30, 0}, SweepOde{1, 2, 30}};
  job.blends[0].shape.frame = BlendFrame::moving;
  const Blend still = blend_of(job);
  for_all(
      [&](Rng& rng) {
        const RigidMotion motion = random_motion(rng, 10.0);
        EXPECT_LE(difference(exact(still), exact(blend_of(moved(job, motion))), motion), 1e-11);
      },
      5);
}

TEST(Invariance, ScalesWithThePart) {
  for_each_joint({"branch-to-main", "leaning-cylinder", "open-blend"}, [](const JobSpec& job) {
    const JobResult original = run_job(job);
    for (const double factor : {1e-3, 1e3}) {
      SCOPED_TRACE(factor);
      const JobResult other = run_job(scaled(job, factor));
      const auto enlarge = [factor](const Vec3& x) { return Vec3(factor * x); };
      EXPECT_LE(difference(exact(original), exact(other), enlarge), 1e-11);
      EXPECT_TRUE(verified(other));
      EXPECT_EQ(other.blends[0].fit.report.control_points, original.blends[0].fit.report.control_points);
    }
  });
}

/// Where `start` lies on the closed or open line.
double parameter_of(const Trimline& line, const Vec3& start) {
  const CurveDomain domain = line.domain();
  double best = domain.v.lo;
  for (int i = 0; i <= 64; ++i) {
    const double v = domain.v.at(i / 64.0);
    if ((line.jet(v).C() - start).norm() < (line.jet(best).C() - start).norm()) best = v;
  }
  return closest_point(Curve3(line), start, best).v;
}

/// The first point of `a` on `b`, found on trimline 0 of a, which is line `on` of b.
Match match(const OdeBlend& a, const Blend& b, std::size_t on, double sign) {
  const double v0 = a.domain().v.lo;
  const double at = parameter_of(*b.trimlines[on], a.jet({0.0, v0}).S);
  return {on == 1, at - sign * v0, sign};
}

TEST(Invariance, SwappingTheSidesReversesU) {
  for_each_joint({"branch-to-main", "leaning-cylinder", "open-blend"}, [](const JobSpec& job) {
    const Blend there = blend_of(job), back = blend_of(swapped(job));
    const Match m = match(exact(there), back, 1, 1.0);
    // The same arc length on both ways; the seam offset is a sum over 256 other places of the lines.
    EXPECT_LE(difference(exact(there), exact(back), same, m), 1e-11);
    // Negative control: a thousandth of a turn aside is another point.
    EXPECT_GT(difference(exact(there), exact(back), same, {m.u_reversed, m.start + 1e-3, m.sign}), 1e-5);
  });
}

/// The arc length of a line that does not run evenly is known exactly at 64 or more places of it, and its
/// speed to 1e-6 everywhere: two maps of one line differ by at most 2 * 1e-6 / 128 of its length, where it is
/// at most 5 sizes long. The blend follows its ends with weights that add up to less than 2.
constexpr double by_arc_length = 2.0 * 5.0 * 2e-6 / 128.0;

struct Telling {
  bool backwards = false;
  double shift = 0.0;  ///< of the seam, closed lines
};

std::vector<Telling> tellings(const SurfaceDomain& domain) {
  if (domain.v_closed) return {{true, 0.0}, {false, 1.234}, {true, 5.1}};
  return {{true, 0.0}};
}

TEST(Invariance, DirectionAndSeamOfALineAreOfNoConsequence) {
  for_each_joint({"branch-to-main", "leaning-cylinder", "open-blend"}, [](const JobSpec& job) {
    const Blend plain = blend_of(job);
    for (const Telling& t : tellings(exact(plain).domain())) {
      SCOPED_TRACE(t.shift);
      // Line 1 follows line 0, which rules the parameter.
      const Blend first = blend_of(run_through(job, 0, t.backwards, t.shift));
      const Match m = match(exact(plain), first, 0, t.backwards ? -1.0 : 1.0);
      EXPECT_LE(difference(exact(plain), exact(first), same, m), by_arc_length);
      EXPECT_GT(difference(exact(plain), exact(first), same, {false, m.start + 1e-3, m.sign}), 1e-5);
      const Blend second = blend_of(run_through(job, 1, t.backwards, t.shift));
      EXPECT_LE(difference(exact(plain), exact(second), same), by_arc_length);
    }
  });
}

TEST(Invariance, DirectionAndSeamAreOfNoConsequenceToRoundingWhereTheLinesKeepTheirParameter) {
  for_each_joint({"branch-to-main", "leaning-cylinder", "open-blend"}, [](JobSpec job) {
    job.blends[0].correspondence.rule = CorrespondenceRule::as_given;
    const Blend plain = blend_of(job);
    const SurfaceDomain domain = exact(plain).domain();
    for (const Telling& t : tellings(exact(plain).domain())) {
      SCOPED_TRACE(t.shift);
      const JobSpec first = run_through(job, 0, t.backwards, t.shift);
      const Blend both = blend_of(run_through(first, 1, t.backwards, t.shift));
      const Match m = match(exact(plain), both, 0, t.backwards ? -1.0 : 1.0);
      EXPECT_LE(difference(exact(plain), exact(both), same, m), 1e-11);

      // One line alone, and the correspondence told to undo it.
      JobSpec undone = run_through(job, 1, t.backwards, t.shift);
      undone.blends[0].correspondence.reverse = t.backwards;
      if (domain.v_closed) undone.blends[0].correspondence.seam_offset = -t.shift / domain.v.length();
      EXPECT_LE(difference(exact(plain), exact(blend_of(undone)), same), 1e-11);
    }
  });
}

TEST(Invariance, VerdictAndKeptPartsDoNotDependOnTheTelling) {
  for (const JobSpec& job : {isotropic(example_job("branch-to-main"), Continuity::G2),
                             isotropic(torus_to_roof(), Continuity::G2)}) {
    SCOPED_TRACE(job.name);
    const std::array<bool, 2> kept = blend_of(job).tangents->kept_left;
    EXPECT_TRUE(verified(run_job(job)));
    const JobResult back = run_job(swapped(job));
    EXPECT_TRUE(verified(back));
    EXPECT_EQ(back.blends[0].blend.tangents->kept_left, (std::array{kept[1], kept[0]}));
    for (const std::size_t side : {0u, 1u}) {
      const JobResult told = run_job(run_through(job, side, true, 1.234));
      EXPECT_TRUE(verified(told));
      // Both lines run as line 0 does.
      EXPECT_EQ(told.blends[0].blend.tangents->kept_left,
                side == 0 ? (std::array{!kept[0], !kept[1]}) : kept);
    }
  }
}

/// Negative control: the sweep equation pulls towards the origin of the coordinates. A translation t moves
/// the points by the sum of the position functions times t, which is 1 at the ends only.
TEST(Invariance, OriginModeFollowsRotationsButNotTranslations) {
  for (const Continuity continuity : {Continuity::G1, Continuity::G2}) {
    JobSpec job = isotropic(example_job("leaning-cylinder"), continuity);
    job.blends[0].shape.mode = BlendMode::origin;
    const Blend still = blend_of(job);
    const CardinalBasis& basis = exact(still).basis(0);
    const auto second = static_cast<std::size_t>(basis.count()) / 2;
    double lag = 0.0;
    for (int i = 0; i <= 10; ++i) {
      const auto phi = basis(0.1 * i).value[0];
      lag = std::max(lag, std::abs(1.0 - phi[0] - phi[second]));
    }
    EXPECT_GT(lag, 1e-4);
    for_all(
        [&](Rng& rng) {
          const RigidMotion turn{random_rotation(rng), Vec3::Zero()};
          EXPECT_LE(difference(exact(still), exact(blend_of(moved(job, turn))), turn), 1e-11);
          const RigidMotion push{Eigen::Matrix3d::Identity(), random_vector(rng, 10.0)};
          const Blend pushed = blend_of(moved(job, push));
          EXPECT_NEAR(difference(exact(still), exact(pushed), push),
                      lag * push.t.norm() / size_of(exact(pushed)), 1e-11);
        },
        2);
  }
}

/// Negative control: in fixed axes, components with equations of their own mix when the part turns.
TEST(Invariance, EquationsThatDifferFollowTranslationsButNotRotations) {
  JobSpec job = isotropic(example_job("leaning-cylinder"), Continuity::G1);
  job.blends[0].shape.ode = {SweepOde{1, -3, 2}, SweepOde{1, -30, 0}, SweepOde{1, 2, 30}};
  const Blend still = blend_of(job);
  for_all(
      [&](Rng& rng) {
        const RigidMotion push{Eigen::Matrix3d::Identity(), random_vector(rng, 10.0)};
        EXPECT_LE(difference(exact(still), exact(blend_of(moved(job, push))), push), 1e-11);
        const RigidMotion turn{random_rotation(rng), Vec3::Zero()};
        EXPECT_GT(difference(exact(still), exact(blend_of(moved(job, turn))), turn), 1e-3);
      },
      3);
}

}  // namespace
}  // namespace blendwright
