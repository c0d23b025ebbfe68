"""Exact signs: orientation, incircle and their counterpart on the sphere.

The kernel evaluates each polynomial in doubles with a derived error bound, then, where that leaves the sign open, in
about twice the precision, and in integers at last: the answer is always that of exact arithmetic on the given doubles.
Plane: the idea of Shewchuk's staged predicates ("Adaptive precision floating-point arithmetic", 1997); sphere: the
curvature form of the paper's idea to lift flat regions (rows P5 and P6 of the ledger).
"""

from stereodel.predicates.signs import in_bubble, incircle, orient2d, orient3d

__all__ = ["in_bubble", "incircle", "orient2d", "orient3d"]
