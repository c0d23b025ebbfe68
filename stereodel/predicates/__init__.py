"""Exact signs: orientation, incircle and their counterpart on the sphere.

Each predicate evaluates its polynomial in doubles with a derived error bound and, where that leaves the sign open,
in Python integers. The answer is always that of exact arithmetic on the given doubles. Plane: Shewchuk's staged
predicates ("Adaptive precision floating-point arithmetic", 1997) with integers as the last stage; sphere: the
curvature form of the paper's idea to lift flat regions (rows P5 and P6 of the ledger).
"""

from stereodel.predicates.plane import incircle, orient2d
from stereodel.predicates.rays import in_bubble
from stereodel.predicates.space import orient3d

__all__ = ["in_bubble", "incircle", "orient2d", "orient3d"]
