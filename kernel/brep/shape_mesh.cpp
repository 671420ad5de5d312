#include "kernel/brep/shape_mesh.hpp"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>

#include "kernel/brep/occt_geometry.hpp"
#include "kernel/brep/occt_surface.hpp"
#include "kernel/brep/shape_impl.hpp"
#include "kernel/geometry/curvature.hpp"

namespace blendwright {
namespace {

/// Sums of triangle normals: for points where the surface itself has none.
std::vector<Vec3> triangle_normals(const TriMesh& mesh) {
  std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
  for (const auto& t : mesh.triangles) {
    const Vec3 n = (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
    for (const auto i : t) normals[i] += n;
  }
  return normals;
}

TriMesh mesh_of(const TopoDS_Face& face, const std::string& name) {
  TriMesh mesh;
  mesh.name = name;
  TopLoc_Location location;
  const auto triangulation = BRep_Tool::Triangulation(face, location);
  if (triangulation.IsNull() || !triangulation->HasUVNodes())
    throw GeometryError("face " + name + ": the CAD kernel makes no triangles of it");
  const bool reversed = face.Orientation() == TopAbs_REVERSED;
  for (int i = 1; i <= triangulation->NbTriangles(); ++i) {
    int a = 0, b = 0, c = 0;
    triangulation->Triangle(i).Get(a, b, c);
    if (reversed) std::swap(b, c);
    const auto index = [](int k) { return static_cast<std::uint32_t>(k - 1); };
    mesh.triangles.push_back({index(a), index(b), index(c)});
  }
  const detail::FaceGeometry g = detail::face_geometry(face);
  const detail::OcctSurface surface(g.geometry, false, g.box);
  Column u{"u", "", 1, {}}, v{"v", "", 1, {}}, mean{"mean_curvature", "", 1, {}},
      gauss{"gaussian_curvature", "", 1, {}};
  for (int i = 1; i <= triangulation->NbNodes(); ++i) {
    mesh.points.push_back(detail::vec(triangulation->Node(i).Transformed(location)));
    const gp_Pnt2d uv = triangulation->UVNode(i);
    const SurfaceJet jet = surface.jet({uv.X(), uv.Y()});
    const SurfaceCurvature k = curvature(jet);
    mesh.normals.push_back(reversed ? Vec3(-unit_normal(jet)) : unit_normal(jet));
    u.values.push_back(uv.X());
    v.values.push_back(uv.Y());
    mean.values.push_back(reversed ? -k.mean : k.mean);
    gauss.values.push_back(k.gaussian);
  }
  const std::vector<Vec3> flat = triangle_normals(mesh);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i)
    if (mesh.normals[i].isZero(0.0)) mesh.normals[i] = flat[i].normalized();
  mesh.columns = {u, v, mean, gauss};
  return mesh;
}

}  // namespace

std::vector<TriMesh> tessellate(const Shape& shape, double chord, Radians angle) {
  return tessellate(shape, chord, angle, [](const std::string&) { return true; });
}

std::vector<TriMesh> tessellate(const Shape& shape, double chord, Radians angle,
                                const std::function<bool(const std::string& name)>& wanted) {
  return detail::guarded<GeometryError>("triangles of the shape", [&] {
    TopoDS_Compound faces;
    const BRep_Builder builder;
    builder.MakeCompound(faces);
    std::vector<std::string> names;
    std::size_t i = 0;
    for (TopExp_Explorer f(shape.impl().shape, TopAbs_FACE); f.More(); f.Next(), ++i) {
      if (!wanted(shape.impl().faces[i].name)) continue;
      builder.Add(faces, f.Current());
      names.push_back(shape.impl().faces[i].name);
    }
    // Triangles are stored in the shape: a copy takes them, the value stays as it is.
    BRepBuilderAPI_Copy copy(faces);
    const BRepMesh_IncrementalMesh mesher(copy.Shape(), chord, false, angle.value, false);
    std::vector<TriMesh> meshes;
    i = 0;
    for (TopExp_Explorer f(copy.Shape(), TopAbs_FACE); f.More(); f.Next(), ++i)
      meshes.push_back(mesh_of(TopoDS::Face(f.Current()), names[i]));
    return meshes;
  });
}

std::vector<FaceSide> sides_of_faces(const Shape& shape) {
  std::vector<FaceSide> sides;
  std::size_t i = 0;
  for (TopExp_Explorer f(shape.impl().shape, TopAbs_FACE); f.More(); f.Next(), ++i)
    sides.push_back({shape.impl().faces[i].name, f.Current().Orientation() == TopAbs_REVERSED});
  return sides;
}

}  // namespace blendwright
