#include "mesh/mesh.hpp"

#include <algorithm>
#include <iterator>

namespace stereodel::mesh {
Mesh::Mesh(const Index* simplices, const Index* neighbors, std::size_t count, Stop stop) {
    facets_.reserve(count + count / 16 + 64);
    facets_.resize(count);
    for (const Index t : copy_rows(simplices, neighbors, count, stop)) {
        for (std::size_t k = 0; k < 3; ++k) {
            if ((*this)[t].neighbor[k] < 0) {
                add_ghost(t, k);
            }
        }
    }
    for (Index ghost = static_cast<Index>(count); ghost < slots(); ++ghost) {
        link_ghost(ghost);
    }
}

// Returns the triangles without a neighbour somewhere.
std::vector<Index> Mesh::copy_rows(const Index* simplices, const Index* neighbors, std::size_t count, Stop stop) {
    std::vector<Index> border;
    bool sorted = true;
    for_range(0, count, stop, [&](std::size_t t) {
        const Index* c = simplices + 3 * t;
        const Index* n = neighbors + 3 * t;
        sorted &= (c[0] < c[1]) & (c[0] < c[2]);
        facets_[t] = {{c[0], c[1], c[2]}, {n[0], n[1], n[2]}};
        if ((n[0] | n[1] | n[2]) < 0) {
            border.push_back(static_cast<Index>(t));
        }
    });
    for (std::size_t t = 0; t < count && !sorted; ++t) {
        put(static_cast<Index>(t), facets_[t].corner, facets_[t].neighbor);
    }
    return border;
}

// The ghost facet beyond an edge of t; its two other neighbours are linked when all ghosts are there.
void Mesh::add_ghost(Index t, std::size_t opposite) {
    const Index ghost = slots();
    const Index u = (*this)[t].corner[(opposite + 1) % 3], v = (*this)[t].corner[(opposite + 2) % 3];
    facets_.push_back({});
    put(ghost, {GHOST, v, u}, {t, GHOST, GHOST});
    at(t).neighbor[opposite] = ghost;
}

// Its facet across v GHOST lies beyond the hull edge out of v, found by turning around v. Over all ghosts this visits
// no facet more than three times.
void Mesh::link_ghost(Index ghost) {
    const Index v = (*this)[ghost].corner[1];
    Index t = (*this)[ghost].neighbor[0];
    do {
        const Facet& facet = (*this)[t];
        t = facet.neighbor[(facet.place(v) + 2) % 3];  // across the edge out of v
    } while (!(*this)[t].is_ghost());
    at(ghost).neighbor[2] = t;
    at(t).neighbor[1] = ghost;
}

void Mesh::move(Index from, Index to) {
    const Facet facet = (*this)[from];
    at(to) = facet;
    for (std::size_t k = 0; k < 3; ++k) {
        set_neighbor(facet.neighbor[k], facet.corner[(k + 1) % 3], facet.corner[(k + 2) % 3], to);
    }
    at(from).corner[0] = unused;
}

std::vector<Index> Mesh::all_ghosts() const {
    std::vector<Index> ring;
    if (ghosts_ > 0) {
        Index t = last_ghost_;
        do {
            ring.push_back(t);
            t = (*this)[t].neighbor[2];
        } while (t != last_ghost_);
    }
    return ring;
}

// Ghosts go from low numbers to new ones at the end, triangles from there to the low numbers that are not in use.
void Mesh::tidy() {
    const Index count = static_cast<Index>(triangles());
    std::vector<Index> low;
    std::copy_if(free_.begin(), free_.end(), std::back_inserter(low), [count](Index t) { return t < count; });
    for (const Index ghost : all_ghosts()) {
        if (ghost < count) {
            facets_.push_back({});
            move(ghost, slots() - 1);
            low.push_back(ghost);
            last_ghost_ = slots() - 1;
        }
    }
    free_.clear();
    for (Index t = slots() - 1; t >= count; --t) {
        if (in_use(t) && !(*this)[t].is_ghost()) {
            move(t, low.back());
            low.pop_back();
        }
        if (!in_use(t)) {
            free_.push_back(t);
        }
    }
}

void Mesh::write(Index* simplices, Index* neighbors, Stop stop) {
    tidy();
    const Index count = static_cast<Index>(triangles());
    for_range(0, triangles(), stop, [&](std::size_t t) {
        const Facet& facet = facets_[t];
        for (std::size_t k = 0; k < 3; ++k) {
            simplices[3 * t + k] = facet.corner[k];
            neighbors[3 * t + k] = facet.neighbor[k] < count ? facet.neighbor[k] : -1;
        }
    });
}

void Mesh::rename(Index start, Index vertex, Index other) {
    Index t = start;
    do {
        const Index next = next_around(t, vertex);
        Facet facet = (*this)[t];
        facet.corner[facet.place(vertex)] = other;
        ghosts_ -= facet.is_ghost();
        put(t, facet.corner, facet.neighbor);
        t = next;
    } while (t != start);
}

void Mesh::renumber(const Index* number, Stop stop) {
    for_range(0, facets_.size(), stop, [&](std::size_t t) {
        for (Index& corner : facets_[t].corner) {
            corner = corner < 0 ? corner : number[corner];
        }
    });
}

}  // namespace stereodel::mesh
