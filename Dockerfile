# docker build -t stereodel . && docker run --rm -v "$PWD:/data" stereodel voronoi cities.csv -o cells.geojson
# A wheel is compiled in the first image, and installed in the second, which has no compiler.
FROM python:3.13 AS build
COPY pyproject.toml CMakeLists.txt README.md LICENSE NOTICES.md /source/
COPY tools/readme_metadata.py /source/tools/
COPY stereodel /source/stereodel
RUN pip wheel --no-cache-dir --no-deps --wheel-dir /wheels /source

FROM python:3.13-slim
ARG EXTRAS=cli,draw
COPY --from=build /wheels /wheels
RUN pip install --no-cache-dir "$(echo /wheels/*.whl)[$EXTRAS]"
RUN stereodel --version
WORKDIR /data
ENTRYPOINT ["stereodel"]
