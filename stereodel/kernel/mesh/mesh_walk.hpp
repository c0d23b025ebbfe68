// What the surfaces of plane and sphere share when they look for a place in a mesh.
#pragma once

#include "mesh/mesh.hpp"
#include "mesh/walk.hpp"

namespace stereodel::mesh {

constexpr Index nobody = -1;  // no vertex

// A facet that a point sees; or, if there is an equal vertex already, this one and a facet that has it.
struct Location {
    Index facet;
    Index equal;
};

// A mesh as `walk` asks for it; `enter(facet)`: whether a walk may go there.
template <class Enter>
struct WalkedMesh {
    const Mesh& mesh;
    Enter enter;

    const Index* corners(Index t) const { return mesh[t].corner.data(); }
    const Index* neighbors(Index t) const { return mesh[t].neighbor.data(); }
    bool may_enter(Index t) const { return enter(mesh[t]); }
};

template <class Enter>
WalkedMesh(const Mesh&, Enter) -> WalkedMesh<Enter>;

}  // namespace stereodel::mesh
