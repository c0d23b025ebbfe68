"""What knows a file format: text and CSV, GeoJSON, well-known binary, Parquet, and what GDAL reads."""
