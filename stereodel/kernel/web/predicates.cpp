// Exact signs for rows of points; one row alone stands for as many as the others have.
#include "predicates/predicate_rows.hpp"

#include <cstddef>
#include <cstdint>

#include "web/answer.hpp"

namespace stereodel::web {

namespace signs = predicates::signs;

STEREODEL_EXPORT(plane_turn)
void plane_turn(const double* a, std::size_t as, const double* b, std::size_t bs, const double* c, std::size_t cs,
                std::int8_t* out) {
    signs::orient2d({"a", a, as}, {"b", b, bs}, {"c", c, cs}, out, alone, nullptr);
}

STEREODEL_EXPORT(sphere_turn)
void sphere_turn(const double* a, std::size_t as, const double* b, std::size_t bs, const double* c, std::size_t cs,
                 std::int8_t* out) {
    signs::turn({"a", a, as}, {"b", b, bs}, {"c", c, cs}, out, alone, nullptr);
}

STEREODEL_EXPORT(plane_in_circle)
void plane_in_circle(const double* a, std::size_t as, const double* b, std::size_t bs, const double* c, std::size_t cs,
                     const double* d, std::size_t ds, std::int8_t* out) {
    signs::incircle({"a", a, as}, {"b", b, bs}, {"c", c, cs}, {"d", d, ds}, out, alone, nullptr);
}

STEREODEL_EXPORT(sphere_in_circle)
void sphere_in_circle(const double* a, std::size_t as, const double* b, std::size_t bs, const double* c,
                      std::size_t cs, const double* p, std::size_t ps, std::int8_t* out) {
    signs::in_bubble({"a", a, as}, {"b", b, bs}, {"c", c, cs}, {"p", p, ps}, out, alone, nullptr);
}

STEREODEL_EXPORT(orient3d)
void orient3d(const double* a, std::size_t as, const double* b, std::size_t bs, const double* c, std::size_t cs,
              const double* d, std::size_t ds, std::int8_t* out) {
    signs::orient3d({"a", a, as}, {"b", b, bs}, {"c", c, cs}, {"d", d, ds}, out, alone, nullptr);
}

}  // namespace stereodel::web
