// Which triangle holds a query, and which points are nearest to it.
#include <cstddef>

#include "queries/k_nearest.hpp"
#include "queries/location.hpp"
#include "queries/nearest.hpp"
#include "queries/nearest_flat.hpp"
#include "web/answer.hpp"

namespace stereodel::web {

using queries::TriangleArrays;

// `closing` is null for the plane, here and below.

STEREODEL_EXPORT(plane_find_simplex)
void plane_find_simplex(const double* points, const Index* simplices, const Index* neighbors, const bool* closing,
                        std::size_t count, const double* queries, std::size_t size, Index* found) {
    queries::find_simplex<2>({points, simplices, neighbors, closing, count}, queries, size, found, alone, nullptr);
}

STEREODEL_EXPORT(sphere_find_simplex)
void sphere_find_simplex(const double* points, const Index* simplices, const Index* neighbors, const bool* closing,
                         std::size_t count, const double* queries, std::size_t size, Index* found) {
    queries::find_simplex<3>({points, simplices, neighbors, closing, count}, queries, size, found, alone, nullptr);
}

STEREODEL_EXPORT(plane_nearest)
void plane_nearest(const double* points, const Index* simplices, const Index* neighbors, const bool* closing,
                   std::size_t count, const double* queries, std::size_t size, Index* found) {
    queries::nearest<2>({points, simplices, neighbors, closing, count}, queries, size, found, alone, nullptr);
}

STEREODEL_EXPORT(sphere_nearest)
void sphere_nearest(const double* points, const Index* simplices, const Index* neighbors, const bool* closing,
                    std::size_t count, const double* queries, std::size_t size, Index* found) {
    queries::nearest<3>({points, simplices, neighbors, closing, count}, queries, size, found, alone, nullptr);
}

STEREODEL_EXPORT(plane_k_nearest)
void plane_k_nearest(const double* points, const Index* simplices, const Index* neighbors, const bool* closing,
                     std::size_t count, const Index* duplicates, std::size_t duplicate_count, const double* queries,
                     std::size_t size, std::size_t k, Index* found) {
    const TriangleArrays triangles(points, simplices, neighbors, closing, count);
    const Pairs pairs = to_pairs(duplicates, duplicate_count);
    queries::k_nearest<2>({triangles, pairs, queries, size, k, found}, alone, nullptr);
}

STEREODEL_EXPORT(sphere_k_nearest)
void sphere_k_nearest(const double* points, const Index* simplices, const Index* neighbors, const bool* closing,
                      std::size_t count, const Index* duplicates, std::size_t duplicate_count, const double* queries,
                      std::size_t size, std::size_t k, Index* found) {
    const TriangleArrays triangles(points, simplices, neighbors, closing, count);
    const Pairs pairs = to_pairs(duplicates, duplicate_count);
    queries::k_nearest<3>({triangles, pairs, queries, size, k, found}, alone, nullptr);
}

// `order`: different points of one line or great circle, in their order there.

STEREODEL_EXPORT(plane_nearest_flat)
void plane_nearest_flat(const double* points, const Index* order, std::size_t different, const Index* duplicates,
                        std::size_t duplicate_count, const double* queries, std::size_t size, std::size_t k,
                        Index* found) {
    const Pairs pairs = to_pairs(duplicates, duplicate_count);
    queries::nearest_flat<2>({points, order, different, pairs, queries, size, k, found}, alone, nullptr);
}

STEREODEL_EXPORT(sphere_nearest_flat)
void sphere_nearest_flat(const double* points, const Index* order, std::size_t different, const Index* duplicates,
                         std::size_t duplicate_count, const double* queries, std::size_t size, std::size_t k,
                         Index* found) {
    const Pairs pairs = to_pairs(duplicates, duplicate_count);
    queries::nearest_flat<3>({points, order, different, pairs, queries, size, k, found}, alone, nullptr);
}

}  // namespace stereodel::web
