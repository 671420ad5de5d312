// Many moving bodies, against all pairs one by one.
#include "implicit/relations/moving_bodies.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>

#include "kernel/base/parallel_for.hpp"
#include "tests/implicit/moving/bodies.hpp"

namespace blendwright::test {
namespace {

/// All pairs, without boxes, memory and threads.
std::vector<Found> one_by_one(const std::vector<ScalarField>& bodies, const std::vector<RigidMotion>& at) {
  std::vector<Found> found;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      const Contact c = collide(placed(bodies[i], at[i]), placed(bodies[j], at[j]), {}).contact;
      if (c != Contact::disjoint) found.push_back({i, j, c});
    }
  return found;
}

std::vector<ScalarField> mixed_bodies(Rng& rng, int count) {
  std::vector<ScalarField> bodies;
  for (int i = 0; i < count; ++i) {
    const auto size = [&rng] { return uniform(rng, 0.4, 1.2); };
    switch (i % 4) {
      case 0: {
        const double radius = size();
        bodies.push_back(ellipsoid(radius, radius, radius));
        break;
      }
      case 1:
        bodies.push_back(ellipsoid(size(), size(), size()));
        break;
      case 2:
        bodies.push_back(box_body({size(), size(), size()}));
        break;
      default:
        bodies.push_back(freeform(rng));
    }
  }
  return bodies;
}

TEST(MovingBodies, FindTheContactsOfAllPairsAtEveryStep) {
  std::size_t contacts = 0, undecided = 0, changes = 0;
  for_all(
      [&](Rng& rng) {
        const std::vector<ScalarField> bodies = mixed_bodies(rng, 16);
        MovingBodies moving(bodies, {});
        Walk walk(rng, bodies.size(), 3.0);
        std::vector<Found> last;
        for (int step = 0; step < 12; ++step) {
          const std::vector<BodyPair> pairs = moving.at(walk.now());
          const std::vector<Found> found = verdicts(pairs);
          ASSERT_EQ(found, one_by_one(bodies, walk.now())) << "step " << step;
          changes += step > 0 && found != last ? 1 : 0;
          last = found;
          for (const BodyPair& p : pairs) {
            undecided += p.collision.contact == Contact::undecided ? 1 : 0;
            if (p.collision.contact != Contact::contact) continue;
            ++contacts;
            ASSERT_TRUE(p.collision.point);
            // Proven by outward ranges at the point itself, so values are not below 0 by more than rounding.
            for (const std::size_t i : {p.first, p.second})
              EXPECT_GE(placed(bodies[i], walk.now()[i]).value(*p.collision.point), -1e-14);
          }
          walk.step(0.15);
        }
      },
      6);
  std::printf("[  figure ] %zu contacts, %zu undecided, %zu changes from step to step\n", contacts, undecided,
              changes);
  EXPECT_GT(contacts, 200u);
  EXPECT_EQ(undecided, 0u);
  EXPECT_GT(changes, 20u) << "contacts come and go";
}

TEST(MovingBodies, AnswersDoNotDependOnWhatWasAskedBefore) {
  for_all(
      [](Rng& rng) {
        const std::vector<ScalarField> bodies = mixed_bodies(rng, 24);
        MovingBodies warm(bodies, {});
        Walk walk(rng, bodies.size(), 3.0);
        std::vector<std::vector<RigidMotion>> path;
        for (int step = 0; step < 8; ++step) {
          path.push_back(walk.now());
          walk.step(0.2);
        }
        std::vector<std::vector<Found>> forth;
        for (const auto& at : path) forth.push_back(verdicts(warm.at(at)));
        for (std::size_t i = path.size(); i-- > 0;) {
          EXPECT_EQ(verdicts(warm.at(path[i])), forth[i]) << "back";
          EXPECT_EQ(verdicts(MovingBodies(bodies, {}).at(path[i])), forth[i]) << "cold";
        }
      },
      8);
}

bool same_bytes(const std::optional<Vec3>& a, const std::optional<Vec3>& b) {
  return a.has_value() == b.has_value() && (!a || std::memcmp(a->data(), b->data(), sizeof(Vec3)) == 0);
}
void expect_same(const std::vector<BodyPair>& a, const std::vector<BodyPair>& b) {
  ASSERT_EQ(verdicts(a), verdicts(b));
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_TRUE(same_bytes(a[i].collision.point, b[i].collision.point));
    EXPECT_TRUE(same_bytes(a[i].collision.normal, b[i].collision.normal));
    EXPECT_EQ(a[i].collision.gap, b[i].collision.gap);
    EXPECT_EQ(a[i].collision.boxes, b[i].collision.boxes);
  }
}

TEST(MovingBodies, AreTheSameForAnyNumberOfThreadsAndAtEveryRun) {
  Rng rng(5);
  const std::vector<ScalarField> bodies = mixed_bodies(rng, 60);
  Walk walk(rng, bodies.size(), 4.0);
  MovingBodies one(bodies, {}), many(bodies, {}), again(bodies, {});
  std::size_t pairs = 0;
  for (int step = 0; step < 6; ++step) {
    std::vector<BodyPair> serial;
    {
      const ThreadLimit limit(1);
      serial = one.at(walk.now(), true);
    }
    const std::vector<BodyPair> parallel = many.at(walk.now(), true);
    expect_same(serial, parallel);
    expect_same(parallel, again.at(walk.now(), true));
    pairs += serial.size();
    walk.step(0.2);
  }
  EXPECT_GT(pairs, 300u);
}

/// Two ellipsoids whose points of support along n stand `gap` apart, which is their distance for gap >= 0.
RigidMotion touching(const Vec3& a, const RigidMotion& at, const Vec3& b, const Eigen::Matrix3d& turn,
                     const Vec3& n, double gap) {
  const auto support = [](const Vec3& s, const Eigen::Matrix3d& R, const Vec3& d) {
    const Vec3 scaled = s.cwiseProduct(R.transpose() * d);
    return Vec3(R * s.cwiseProduct(scaled) / scaled.norm());
  };
  return {turn, at.t + support(a, at.R, n) + gap * n - support(b, turn, -n)};
}

TEST(MovingBodies, PlantedGapsOfAMillionthAreSeen) {
  for_all(
      [](Rng& rng) {
        std::vector<ScalarField> bodies;
        std::vector<RigidMotion> at;
        std::vector<Contact> expected;
        for (int k = 0; k < 8; ++k) {  // pairs far from each other
          Vec3 a, b;
          for (int i = 0; i < 3; ++i) {
            a[i] = uniform(rng, 0.5, 1.5);
            b[i] = uniform(rng, 0.5, 1.5);
          }
          if (k % 4 < 2) a = Vec3::Constant(a[0]), b = Vec3::Constant(b[0]);
          bodies.push_back(ellipsoid(a.x(), a.y(), a.z()));
          bodies.push_back(ellipsoid(b.x(), b.y(), b.z()));
          at.push_back({random_turn(rng), Vec3(10.0 * k, 0.0, 0.0)});
          at.push_back(touching(a, at.back(), b, random_turn(rng), random_vector(rng, 1.0).normalized(),
                                k % 2 ? 1e-6 : -1e-6));
          expected.push_back(k % 2 ? Contact::disjoint : Contact::contact);
        }
        MovingBodies moving(bodies, {});
        for (int run = 0; run < 2; ++run) {  // cold and warm
          std::vector<Contact> found(expected.size(), Contact::disjoint);
          for (const BodyPair& p : moving.at(at)) {
            ASSERT_EQ(p.first + 1, p.second);
            found[p.first / 2] = p.collision.contact;
          }
          EXPECT_EQ(found, expected);
        }
        // The same gaps, changed over by the next step: the last contact is no contact any more.
        for (std::size_t k = 0; k < expected.size(); ++k) {
          const Vec3 n = (at[2 * k + 1].t - at[2 * k].t).normalized();
          at[2 * k + 1].t += (k % 2 ? -1e-3 : 1e-3) * n;
        }
        std::size_t contacts = 0;
        for (const BodyPair& p : moving.at(at)) {
          EXPECT_EQ(p.collision.contact, Contact::contact);
          EXPECT_EQ(p.first / 2 % 2, 1u);
          ++contacts;
        }
        EXPECT_EQ(contacts, 4u);
      },
      20);
}

TEST(MovingBodies, AllNamesEveryPairWhoseBoxesMeet) {
  Rng rng(8);
  const std::vector<ScalarField> bodies = mixed_bodies(rng, 30);
  const Walk walk(rng, bodies.size(), 4.0);
  std::vector<std::pair<std::size_t, std::size_t>> meeting, named;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j)
      if (common(*placed(bodies[i], walk.now()[i]).bounds(), *placed(bodies[j], walk.now()[j]).bounds()))
        meeting.emplace_back(i, j);
  std::vector<Found> contacts;
  for (const BodyPair& p : MovingBodies(bodies, {}).at(walk.now(), true)) {
    named.emplace_back(p.first, p.second);
    if (p.collision.contact != Contact::disjoint)
      contacts.push_back({p.first, p.second, p.collision.contact});
  }
  EXPECT_EQ(named, meeting);
  EXPECT_LT(contacts.size(), named.size());
  EXPECT_EQ(verdicts(MovingBodies(bodies, {}).at(walk.now())), contacts);
}

TEST(MovingBodies, ManyBodiesAtOnePlaceAreAllInContact) {
  const std::vector<ScalarField> bodies(20, ellipsoid(1.0, 1.0, 1.0));
  EXPECT_EQ(MovingBodies(bodies, {}).at(std::vector<RigidMotion>(20)).size(), 190u);
}

std::vector<Problem> problems_of_call(const std::function<void()>& call) {
  try {
    call();
    return {};
  } catch (const InputError& e) {
    return e.problems();
  }
}

TEST(MovingBodies, RefuseWhatTheyCannotDecide) {
  const ScalarField ball = ellipsoid(1.0, 1.0, 1.0);
  const ScalarField unknown(ball.shared_model(), ball.level());
  const double infinity = std::numeric_limits<double>::infinity();
  const ScalarField endless(ball.shared_model(), ball.level(), Box{Vec3::Zero(), Vec3(1.0, 1.0, infinity)});
  const auto made = [](std::vector<ScalarField> bodies, double tolerance = 1e-9) {
    return problems_of_call([&] {
      SearchOptions options;
      options.tolerance = tolerance;
      const MovingBodies moving(std::move(bodies), options);
    });
  };
  EXPECT_EQ(made({ball}), (std::vector<Problem>{{"bodies", "has 1, must have at least 2"}}));
  EXPECT_EQ(made({ball, unknown, endless}),
            (std::vector<Problem>{{"bodies/1", "has no known bounds, must lie in a known box"},
                                  {"bodies/2", "is unbounded, must lie in a finite box"}}));
  EXPECT_EQ(made({ball, ball}, 0.0), (std::vector<Problem>{{"tolerance", "is 0, must be a length > 0"}}));
  EXPECT_EQ(made({ball, ball}, infinity).size(), 1u);
  EXPECT_EQ(made({ball, ball}, std::nan("")).size(), 1u);

  MovingBodies moving({ball, ball, ball}, {});
  std::vector<RigidMotion> at(3);
  EXPECT_EQ(moving.at(at).size(), 3u);
  const auto problems = [&](const std::vector<RigidMotion>& placements) {
    return problems_of_call([&] { (void)moving.at(placements); });
  };
  EXPECT_EQ(problems(std::vector<RigidMotion>(2)),
            (std::vector<Problem>{{"placements", "has 2, must have one for each of 3 bodies"}}));
  at[0].t.y() = std::nan("");
  at[2].R(0, 0) = -1.0;
  EXPECT_EQ(problems(at), (std::vector<Problem>{{"placements/0", "has a number that is not finite"},
                                                {"placements/2", "mirrors, must turn and move only"}}));
  EXPECT_EQ(moving.at(std::vector<RigidMotion>(3)).size(), 3u) << "nothing was lost";
}

TEST(MovingBodies, ReportAndStop) {
  const std::vector<ScalarField> bodies(20, ellipsoid(1.0, 1.0, 1.0));
  MovingBodies moving(bodies, {});
  const std::vector<RigidMotion> at(20);
  double last = -1.0;
  Progress progress;
  progress.report = [&last](double fraction, std::string_view) {
    EXPECT_GE(fraction, last);
    last = fraction;
  };
  (void)moving.at(at, false, progress);
  EXPECT_EQ(last, 1.0);
  std::stop_source source;
  progress.stop = source.get_token();
  source.request_stop();
  EXPECT_THROW((void)moving.at(at, false, progress), Cancelled);
  EXPECT_EQ(moving.at(at).size(), 190u) << "a stopped step leaves no trace";
}

}  // namespace
}  // namespace blendwright::test
