#include "nearest.hpp"

#include "nearest_finder.hpp"
#include "query_pieces.hpp"

namespace stereodel {
namespace {

template <class Query>
void scan_all(const TriangleArrays& triangles, std::size_t size, const double* queries, std::size_t count, Index* found,
              int workers, Stop stop) {
    constexpr std::size_t grain = 16;
    Crew crew(useful_workers(workers, count, grain));
    in_grains(count, grain, crew, [&](std::size_t begin, std::size_t end) {
        NearestFinder<Query> finder(triangles, stop);
        for (std::size_t k = begin; k < end; ++k) {
            check(stop);
            found[k] = finder.scan(queries + Query::Chart::dimension * k, size);
        }
    });
}

template <class Query>
void find_nearest(const TriangleArrays& triangles, std::size_t size, const double* queries, std::size_t count,
                  Index* found, int workers, Stop stop) {
    if (triangles.count() == 0) {
        scan_all<Query>(triangles, size, queries, count, found, workers, stop);
        return;
    }
    for_queries<typename Query::Chart>(triangles, first_open(triangles), queries, count, workers, stop, [&] {
        return [found, finder = NearestFinder<Query>(triangles, stop)](
                   std::size_t k, const double* query, Index& near) mutable { found[k] = finder.find(query, near); };
    });
}

}  // namespace

void nearest_plane(const TriangleArrays& triangles, std::size_t size, const double* queries, std::size_t count,
                   Index* found, int workers, Stop stop) {
    find_nearest<PlaneQuery>(triangles, size, queries, count, found, workers, stop);
}

void nearest_sphere(const TriangleArrays& triangles, std::size_t size, const double* queries, std::size_t count,
                    Index* found, int workers, Stop stop) {
    find_nearest<SphereQuery>(triangles, size, queries, count, found, workers, stop);
}

}  // namespace stereodel
