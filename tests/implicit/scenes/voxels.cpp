#include "tests/implicit/scenes/voxels.hpp"

#include <numeric>

#include "kernel/base/parallel_for.hpp"

namespace blendwright::test {

Voxels sample(const ScalarField& field, const Box& box, std::size_t n) {
  Voxels voxels{n, std::vector<std::uint8_t>(n * n * n)};
  const auto place = [&](std::size_t i, int axis) {
    return box.lo[axis] + box.size()[axis] * static_cast<double>(i) / static_cast<double>(n - 1);
  };
  parallel_for(n, 1, [&](std::size_t begin, std::size_t end) {
    std::vector<double> x(n * n), y(n * n), z(n * n);
    for (std::size_t k = begin; k < end; ++k) {
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) {
          x[j * n + i] = place(i, 0);
          y[j * n + i] = place(j, 1);
          z[j * n + i] = place(k, 2);
        }
      const FieldValues layer = field.evaluate(Order::value, PointArrays{x, y, z});
      for (std::size_t i = 0; i < n * n; ++i)
        voxels.inside[k * n * n + i] = inside(field.level(), layer.value(i)) > 0.0 ? 1 : 0;
    }
  });
  return voxels;
}

Voxels difference(const Voxels& a, const Voxels& b) {
  Voxels result = a;
  for (std::size_t i = 0; i < a.inside.size(); ++i)
    if (b.inside[i] != 0) result.inside[i] = 0;
  return result;
}

long euler_characteristic(const Voxels& voxels) {
  const std::size_t n = voxels.n;
  long sum = 0;
  // Every cell of the complex is counted at its lowest corner: it spans one grid step along the axes of the
  // three bits of `cell`, and counts + for an even number of them.
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t cell = 0; cell < 8; ++cell) {
          const std::size_t a = cell & 1u, b = (cell >> 1u) & 1u, c = cell >> 2u;
          if (i + a >= n || j + b >= n || k + c >= n) continue;
          bool full = true;
          for (std::size_t dk = 0; dk <= c && full; ++dk)
            for (std::size_t dj = 0; dj <= b && full; ++dj)
              for (std::size_t di = 0; di <= a && full; ++di)
                full = voxels.inside[((k + dk) * n + j + dj) * n + i + di] != 0;
          if (full) sum += (a + b + c) % 2 == 0 ? 1 : -1;
        }
  return sum;
}

std::size_t components(const Voxels& voxels) {
  const std::size_t n = voxels.n;
  std::vector<std::uint32_t> parent(voxels.inside.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::size_t count = 0;
  for (std::size_t i = 0; i < parent.size(); ++i) {
    if (voxels.inside[i] == 0) continue;
    ++count;
    const auto join = [&](std::size_t other) {
      const std::uint32_t a = root(static_cast<std::uint32_t>(i)),
                          b = root(static_cast<std::uint32_t>(other));
      if (voxels.inside[other] == 0 || a == b) return;
      parent[a] = b;
      --count;
    };
    if (i % n > 0) join(i - 1);
    if (i / n % n > 0) join(i - n);
    if (i / (n * n) > 0) join(i - n * n);
  }
  return count;
}

}  // namespace blendwright::test
