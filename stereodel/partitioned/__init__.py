"""One exact triangulation of more points than memory holds, whatever the partitions and whoever computes them.

Files of points in, files of triangles and of rows for the points out; the extra ``partitioned`` brings what reads them.
"""

from stereodel.partitioned.passes import Execution
from stereodel.partitioned.questions import Answers
from stereodel.partitioned.run import Run, triangulate

__all__ = ["Answers", "Execution", "Run", "triangulate"]
