"""The measurement of the web's kernel: everything is measured, and the tables hold it."""

from benchmarks import pages, web_kernel


def test_a_small_run(node):
    found = web_kernel.measure((50, 200), rounds=1)
    rows = found["rows"]
    assert [row["size"] for row in rows] == [50, 200]
    assert all(value > 0 for row in rows for value in row.values())
    assert 0 < found["sizes"]["wasm, gzip"] < 144 < found["sizes"]["wasm"]
    ratios = found["ratios"]
    assert ratios["web : native, sphere"] == rows[1]["sphere"] / rows[1]["native sphere"]
    assert ratios["delaunator : web, plane"] == rows[1]["delaunator"] / rows[1]["plane"]
    assert pages.web_kernel(found)["times"].count("\n") == 3
