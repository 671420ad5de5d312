// Meshes of corners with signs drawn at random: every case of every cell next to every other, in blocks of
// all sizes, with and without a cap.
#include <gtest/gtest.h>

#include <cmath>

#include "implicit/polygonize/polygonize.hpp"
#include "tests/implicit/polygonize/fields.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::for_all;
using test::Rng;

/// At p the value that belongs to the grid point nearest to p: random, sometimes 0 or infinite. It jumps in
/// the middle between grid points and has no gradient.
class RandomSigns final : public ScalarField::Model {
 public:
  RandomSigns(std::uint64_t seed, double share_inside) : seed_(seed), share_(share_inside) {}
  void evaluate(Order order, PointArrays points, std::span<double> out) const override {
    std::fill(out.begin(), out.end(), 0.0);
    for (std::size_t i = 0; i < points.size(); ++i) out[i] = at(points.x[i], points.y[i], points.z[i]);
    static_cast<void>(order);
  }
  [[nodiscard]] Range range(const Box&) const override { return Range::everything(); }
  [[nodiscard]] Within within(const Box& box) const override { return {range(box), nullptr}; }
  void nearest_member(PointArrays, std::span<std::uint32_t> out) const override {
    std::fill(out.begin(), out.end(), 0u);
  }

 private:
  [[nodiscard]] double at(double x, double y, double z) const {
    const double number = std::round(x) + 100.0 * (std::round(y) + 100.0 * std::round(z));
    Rng rng(seed_ ^ static_cast<std::uint64_t>(number) * 0x9e3779b97f4a7c15ull);
    const bool inside = test::uniform(rng, 0.0, 1.0) < share_;
    const int kind = test::integer(rng, 0, 7);
    if (kind == 0) return inside ? INFINITY : 0.0;
    if (kind == 1) return inside ? 1e-300 : -INFINITY;
    const double size = test::log_uniform(rng, 1e-12, 1e12);
    return inside ? size : -size;
  }
  std::uint64_t seed_;
  double share_;
};

MeshOptions options_of(const Vec3& cells, MeshOptions::AtBox at_box, int newton_steps) {
  MeshOptions options;
  options.cell = 1.0;
  options.box = Box{Vec3::Zero(), cells};
  options.at_box = at_box;
  options.newton_steps = newton_steps;
  options.columns = false;
  return options;
}

Vec3 random_cells(Rng& rng) {
  const int x = test::integer(rng, 1, 19), y = test::integer(rng, 1, 19), z = test::integer(rng, 1, 9);
  return Vec3(x, y, z);
}

FieldMesh random_mesh(Rng& rng, MeshOptions::AtBox at_box) {
  const double share = test::uniform(rng, 0.05, 0.95);
  const ScalarField field(std::make_shared<RandomSigns>(rng.next(), share), Level::function);
  for (;;) {
    try {
      const Vec3 cells = random_cells(rng);
      return polygonize(field, options_of(cells, at_box, test::integer(rng, 0, 2)));
    } catch (const GeometryError&) {
      continue;  // a box of few cells may have all its corners on one side
    }
  }
}

TEST(RandomSigns, WithCapsAreClosed) {
  for_all([](Rng& rng) {
    const FieldMesh made = random_mesh(rng, MeshOptions::AtBox::cap);
    const MeshDefects defects = find_defects(made.mesh, 1.0);
    EXPECT_TRUE(defects.none()) << defects.open_edges << " open " << defects.overused_edges << " overused "
                                << defects.flipped_edges << " flipped " << defects.degenerate_faces
                                << " degenerate " << defects.repeated_points << " repeated";
    EXPECT_GT(made.facts.volume, 0.0);
    EXPECT_EQ(made.facts.euler_characteristic % 2, 0);
  });
}

TEST(RandomSigns, WithoutCapsAreOpenInTheSidesOfTheBoxOnly) {
  for_all([](Rng& rng) {
    const FieldMesh made = random_mesh(rng, MeshOptions::AtBox::open);
    const MeshDefects defects = find_defects(made.mesh, 1.0);
    EXPECT_EQ(
        defects.overused_edges + defects.flipped_edges + defects.degenerate_faces + defects.repeated_points,
        0u);
    // The Euler characteristic counts edges by their number of faces; here they are counted one by one.
    const std::size_t edges = (3 * made.mesh.triangles.size() + defects.open_edges) / 2;
    EXPECT_EQ(
        made.facts.euler_characteristic,
        static_cast<long>(made.mesh.points.size() + made.mesh.triangles.size()) - static_cast<long>(edges));
  });
}

}  // namespace
}  // namespace blendwright
