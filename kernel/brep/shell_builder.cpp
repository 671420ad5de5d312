#include "kernel/brep/shell_builder.hpp"

#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <deque>
#include <map>

namespace blendwright::detail {
namespace {

struct Use {
  std::size_t face = 0;
  TopAbs_Orientation orientation = TopAbs_FORWARD;
};

std::map<int, std::vector<Use>> edge_uses(const std::vector<ShapeFace>& faces) {
  TopTools_IndexedMapOfShape edges;
  std::map<int, std::vector<Use>> uses;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (TopExp_Explorer e(faces[i].face, TopAbs_EDGE); e.More(); e.Next())
      if (!BRep_Tool::Degenerated(TopoDS::Edge(e.Current())))
        uses[edges.Add(e.Current())].push_back({i, e.Current().Orientation()});
  return uses;
}

class Shells {
 public:
  Shells(std::vector<ShapeFace> faces, std::vector<std::string>& warnings)
      : faces_(std::move(faces)),
        warnings_(warnings),
        uses_(edge_uses(faces_)),
        set_(faces_.size(), -1),
        turned_(faces_.size(), 0) {}

  [[nodiscard]] Shape::Impl build() {
    for (const bool blends : {false, true})
      for (std::size_t i = 0; i < faces_.size(); ++i)
        if (faces_[i].blend == blends && set_[i] < 0) spread(i);
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (turned_[i]) faces_[i].face.Reverse();
    const BRep_Builder builder;
    std::vector<TopoDS_Shape> parts;
    for (int s = 0; s < sets_; ++s) parts.push_back(shell(s));
    Shape::Impl result;
    if (parts.size() == 1) {
      result.shape = parts.front();
    } else {
      TopoDS_Compound all;
      builder.MakeCompound(all);
      for (const TopoDS_Shape& p : parts) builder.Add(all, p);
      result.shape = all;
    }
    order_as_in_shape(result);
    return result;
  }

 private:
  void spread(std::size_t first) {
    std::deque<std::size_t> todo{first};
    set_[first] = sets_;
    while (!todo.empty()) {
      const std::size_t i = todo.front();
      todo.pop_front();
      for (const auto& [edge, uses] : uses_)
        for (const Use& a : uses) {
          if (a.face != i) continue;
          for (const Use& b : uses) {
            if (b.face == i) continue;
            const bool agree = (a.orientation != b.orientation) == (turned_[i] == turned_[b.face]);
            if (set_[b.face] < 0) {
              set_[b.face] = sets_;
              turned_[b.face] = agree ? turned_[b.face] : !turned_[b.face];
              todo.push_back(b.face);
            } else if (!agree && !one_sided_) {
              one_sided_ = true;
              warnings_.push_back("the faces form a one-sided shell; their normals cannot agree everywhere");
            }
          }
        }
    }
    ++sets_;
  }

  [[nodiscard]] TopoDS_Shape shell(int set) const {
    const BRep_Builder builder;
    TopoDS_Shell shell;
    builder.MakeShell(shell);
    bool closed = true;
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (set_[i] == set) builder.Add(shell, faces_[i].face);
    for (const auto& [edge, uses] : uses_)
      if (set_[uses.front().face] == set && uses.size() < 2) closed = false;
    shell.Closed(closed);
    if (!closed) return shell;
    TopoDS_Solid solid;
    builder.MakeSolid(solid);
    builder.Add(solid, shell);
    BRepLib::OrientClosedSolid(solid);
    return solid;
  }

  void order_as_in_shape(Shape::Impl& result) {
    for (TopExp_Explorer e(result.shape, TopAbs_FACE); e.More(); e.Next())
      for (const ShapeFace& f : faces_)
        if (f.face.IsSame(e.Current())) {
          result.faces.push_back(f);
          result.faces.back().face = TopoDS::Face(e.Current());
        }
  }

  std::vector<ShapeFace> faces_;
  std::vector<std::string>& warnings_;
  std::map<int, std::vector<Use>> uses_;
  std::vector<int> set_;
  std::vector<char> turned_;
  int sets_ = 0;
  bool one_sided_ = false;
};

}  // namespace

Shape::Impl build_shells(std::vector<ShapeFace> faces, std::vector<std::string>& warnings) {
  return Shells(std::move(faces), warnings).build();
}

}  // namespace blendwright::detail
