#include "queries/nearest.hpp"

#include "queries/nearest_finder.hpp"
#include "queries/query_pieces.hpp"

namespace stereodel::queries {
namespace {

}  // namespace

template <std::size_t Width>
void nearest(const TriangleArrays& triangles, const double* queries, std::size_t count, Index* found, int workers,
                  Stop stop) {
    using Query = QueryOf<Width>;
    for_queries<typename Query::Chart>(triangles, first_open(triangles), queries, count, workers, stop, [&] {
        return [found, finder = NearestFinder<Query>(triangles, stop)](
                   std::size_t k, const double* query, Index& near) mutable { found[k] = finder.find(query, near); };
    });
}

template void nearest<2>(const TriangleArrays&, const double*, std::size_t, Index*, int, Stop);
template void nearest<3>(const TriangleArrays&, const double*, std::size_t, Index*, int, Stop);

}  // namespace stereodel::queries
