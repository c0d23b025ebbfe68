#include "queries/nearest.hpp"

#include "queries/nearest_finder.hpp"
#include "queries/query_pieces.hpp"

namespace stereodel::queries {
namespace {

template <class Query>
void find_nearest(const TriangleArrays& triangles, const double* queries, std::size_t count, Index* found, int workers,
                  Stop stop) {
    for_queries<typename Query::Chart>(triangles, first_open(triangles), queries, count, workers, stop, [&] {
        return [found, finder = NearestFinder<Query>(triangles, stop)](
                   std::size_t k, const double* query, Index& near) mutable { found[k] = finder.find(query, near); };
    });
}

}  // namespace

void nearest_plane(const TriangleArrays& triangles, const double* queries, std::size_t count, Index* found, int workers,
                   Stop stop) {
    find_nearest<PlaneQuery>(triangles, queries, count, found, workers, stop);
}

void nearest_sphere(const TriangleArrays& triangles, const double* queries, std::size_t count, Index* found,
                    int workers, Stop stop) {
    find_nearest<SphereQuery>(triangles, queries, count, found, workers, stop);
}

}  // namespace stereodel::queries
