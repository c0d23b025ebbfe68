// One vertex at a time: take away its star, fill the hole with the facets that it saw.
//
// In the plane, where the ghost is in the link of a vertex of the hull, the hole ends at a new piece of the hull: the
// part of the convex hull of its other border that can be seen from the vertex. Between this piece and the border lie
// pockets, each a hole of its own without the ghost.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "mesh/mesh_walk.hpp"
#include "mesh/polygon_fill.hpp"

namespace stereodel::mesh {

template <class Surface>
class Removal {
  public:
    // `facet_at`: for each vertex that is still to be removed a facet that has it, for others -1; kept up to date.
    Removal(Mesh& mesh, Surface& surface, Index* facet_at, Stop stop)
        : mesh_(mesh), surface_(surface), facet_at_(facet_at), stop_(stop) {}

    // Needs four vertices, the ghost among them, and a surface that is not flat. Returns a facet beside the hole.
    Index remove(Index vertex) {
        take_away_star(vertex);
        facet_at_[vertex] = -1;
        patch_.clear();
        if (link_[0] == GHOST) {
            if constexpr (Surface::has_ghost) {
                fill_to_hull();
            }
        } else {
            fill_hole(0, link_.size() - 1, ~static_cast<Index>(link_.size() - 1));
        }
        put_patch();
        return made_.front();
    }

  private:
    // Corners by place in the link; neighbours by place in the patch, or ~k: what lies across the link's edge from
    // place k to the next one.
    struct Piece {
        std::array<Index, 3> corner, neighbor;
    };

    static std::size_t at(Index k) { return static_cast<std::size_t>(k); }

    // Then `link_` is its border, counterclockwise, the ghost first if there, and `across_[k]` what lies beyond its
    // edge from place k to the next one.
    void take_away_star(Index vertex) {
        star_.clear();
        Index t = facet_at_[vertex];
        do {
            star_.push_back(t);
            t = mesh_.next_around(t, vertex);
        } while (t != star_[0]);
        const auto follows_ghost = [&](Index s) { return mesh_[s].corner[(mesh_[s].place(vertex) + 1) % 3] == GHOST; };
        const auto ghost = std::find_if(star_.begin(), star_.end(), follows_ghost);
        if (ghost != star_.end()) {
            std::rotate(star_.begin(), ghost, star_.end());
        }
        link_.clear();
        across_.clear();
        for (const Index s : star_) {
            const std::size_t k = mesh_[s].place(vertex);
            link_.push_back(mesh_[s].corner[(k + 1) % 3]);
            across_.push_back(mesh_[s].neighbor[k]);
            mesh_.release(s);
        }
    }

    // Fill the hole whose border are the places first to last of the link and the edge back, across which lies
    // `beyond`. Returns the piece at this edge.
    Index fill_hole(std::size_t first, std::size_t last, Index beyond) {
        border_.assign(link_.begin() + static_cast<std::ptrdiff_t>(first),
                       link_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
        fill_.run(
            border_, [this](Index a, Index b, Index c, Index p) { return surface_.in_bubble(a, b, c, p); }, stop_);
        const Index base = static_cast<Index>(patch_.size()), shift = static_cast<Index>(first);
        for (const PolygonFill::Triangle& triangle : fill_.triangles()) {
            Piece piece;
            for (std::size_t k = 0; k < 3; ++k) {
                const Index from = triangle.corner[(k + 1) % 3], other = triangle.neighbor[k];
                piece.corner[k] = shift + triangle.corner[k];
                piece.neighbor[k] = other != PolygonFill::border ? base + other
                                    : at(from) == last - first   ? beyond
                                                                 : ~(shift + from);
            }
            patch_.push_back(piece);
        }
        return base + fill_.triangle_at(last - first);
    }

    // The places 1, 2, ... of the link stand counterclockwise around the vertex, within half a turn. What it sees of
    // their hull is found by the scan of R. Graham (1972): seen from the vertex this is the lower hull of points in the
    // order of their abscissae. Points on a side of the hull are vertices of it.
    void fill_to_hull() {
        chain_.clear();
        for (std::size_t k = 1; k < link_.size(); ++k) {
            while (chain_.size() >= 2 &&
                   surface_.orient(link_[chain_[chain_.size() - 2]], link_[chain_.back()], link_[k]) > 0) {
                chain_.pop_back();
            }
            chain_.push_back(k);
        }
        const std::size_t edges = chain_.size() - 1;
        patch_.resize(edges);
        for (std::size_t k = 0; k < edges; ++k) {
            const std::size_t i = chain_[k], j = chain_[k + 1];
            const Index ghost = static_cast<Index>(k), from = static_cast<Index>(i), to = static_cast<Index>(j);
            const Index inner = j == i + 1 ? ~from : fill_hole(i, j, ghost);
            patch_[k] = {{0, from, to}, {inner, k + 1 < edges ? ghost + 1 : ~to, k > 0 ? ghost - 1 : ~Index{0}}};
        }
    }

    void put_patch() {
        made_.resize(patch_.size());
        for (Index& t : made_) {
            t = mesh_.take();
        }
        for (std::size_t m = 0; m < patch_.size(); ++m) {
            const Piece& piece = patch_[m];
            std::array<Index, 3> corner, neighbor;
            for (std::size_t k = 0; k < 3; ++k) {
                corner[k] = link_[at(piece.corner[k])];
                neighbor[k] = piece.neighbor[k] >= 0 ? made_[at(piece.neighbor[k])] : across_[at(~piece.neighbor[k])];
            }
            mesh_.put(made_[m], corner, neighbor);
            for (std::size_t k = 0; k < 3; ++k) {
                if (piece.neighbor[k] < 0) {
                    mesh_.set_neighbor(neighbor[k], corner[(k + 1) % 3], corner[(k + 2) % 3], made_[m]);
                }
                if (corner[k] != GHOST && facet_at_[corner[k]] >= 0) {
                    facet_at_[corner[k]] = made_[m];
                }
            }
        }
    }

    Mesh& mesh_;
    Surface& surface_;
    Index* facet_at_;
    Stop stop_;
    PolygonFill fill_;
    std::vector<Index> star_, link_, across_, border_, made_;
    std::vector<std::size_t> chain_;
    std::vector<Piece> patch_;
};

}  // namespace stereodel::mesh
