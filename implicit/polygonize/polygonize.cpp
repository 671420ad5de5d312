#include "implicit/polygonize/polygonize.hpp"

#include <stdexcept>

namespace blendwright {

FieldMesh polygonize(const ScalarField&, const MeshOptions&, const Progress&) {
  throw std::logic_error("polygonize");
}
MeshDefects find_defects(const TriMesh&, double) { throw std::logic_error("polygonize"); }

}  // namespace blendwright
