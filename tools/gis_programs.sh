#!/usr/bin/env bash
# Usage: tools/gis_programs.sh VENV
# What the command writes, opened by programs that share no library with it: GDAL's, QGIS and CDO of the system. Each line
# says what a program found in a file, and what it must find; the first one that differs ends with 1.
source "$(dirname "${BASH_SOURCE[0]}")/shell.sh"
use "$1"
qgis=$(command -v qgis_process.bin qgis_process | head -1 || true) # the former first: Debian's wrapper adds an option
if [[ -z $qgis ]] || ! command -v ogrinfo gdalinfo cdo >/dev/null; then die "on Debian: apt-get install gdal-bin cdo qgis"; fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export QT_QPA_PLATFORM=offscreen XDG_RUNTIME_DIR=$folder HOME=$folder
printf '%s\n' name,lon,lat,people Quito,-78.5,-0.2,2800000 Lagos,3.4,6.5,15400000 Ulm,10.0,48.4,128000 \
    Kyoto,135.8,35.0,1460000 Perth,115.9,-32.0,2110000 Suva,178.4,-18.1,90000 >cities.csv

# A pattern that the output of a program must have.
found() {
    local pattern=$1 said
    shift
    said=$("$@" 2>&1) || die "$* ends with an error: $said"
    grep -Eq "$pattern" <<<"$said" || die "$* does not say $pattern, but $said"
    echo "$1: $(grep -Eo "$pattern" <<<"$said" | head -1)"
}

process() { env -u PYTHONPATH PATH=/usr/bin:/bin "$qgis" run "$@"; }

for kind in gpkg geojson shp fgb kml; do
    stereodel voronoi cities.csv -o cells.$kind
    found 'Feature Count: 6' ogrinfo -so -al cells.$kind
done
for kind in gpkg geojson; do # by GEOS
    found 'VALID_COUNT:[[:space:]]*6' process qgis:checkvalidity -- INPUT_LAYER=cells.$kind METHOD=2 \
        VALID_OUTPUT=valid.gpkg INVALID_OUTPUT=invalid.gpkg ERROR_OUTPUT=errors.gpkg
done
stereodel triangulate cities.csv -o triangles.gpkg
found 'OUTPUT:' process native:centroids -- INPUT=triangles.gpkg OUTPUT=centroids.gpkg
stereodel contour cities.csv --value people --levels 1000000 -o lines.gpkg
found 'Geometry: (Multi )?Line String' ogrinfo -so -al lines.gpkg
stereodel interpolate cities.csv --value people --grid 5 --bounds world -o grid.nc
found 'lon : -180 to 175 by 5 degrees_east' cdo -s sinfon grid.nc
stereodel interpolate cities.csv --value people --grid 5 --bounds world -o grid.tif
found 'ID\["EPSG",4326\]' gdalinfo grid.tif
found 'MAX:[[:space:]]*[0-9]+' process native:rasterlayerstatistics -- INPUT=grid.tif BAND=1
stereodel voronoi cities.csv -o mesh.nc
found 'NetCDF4' cdo -s sinfo mesh.nc
