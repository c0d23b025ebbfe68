"""One exact triangulation of more points than memory holds, whatever the partitions and whoever computes them.

Files of points in, files of triangles and of rows for the points out; the extra ``partitioned`` brings what reads them.
"""

from stereodel.partitioned.run import Run, triangulate
from stereodel.partitioned.targets import Answers

__all__ = ["Answers", "Run", "triangulate"]
