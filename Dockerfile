# Veldt on Debian 13, with Blender, for an ordinary user. To build it, and to make a dataset in the current folder:
#
#   docker build --tag veldt .
#   docker run --rm --user "$(id -u):$(id -g)" --volume "$PWD:/data" veldt generate my.json --out my_dataset
#
# Without --user, files belong to user 1000. `./run fresh --container` replays each line without Docker; it knows the
# instructions that are here, in the form they have here.

FROM debian:trixie-slim AS build
WORKDIR /veldt
COPY . .
RUN ./run build && cmake --install build/release --prefix /installed --strip

FROM debian:trixie-slim
# Blender, what the Python side imports, and the libraries that the program and its module are linked with.
RUN apt-get update \
    && apt-get install --yes --no-install-recommends blender python3-numpy python3-openimageio \
        coinor-libcbc3.1 libarchive13t64 libavcodec61 libavformat61 libavutil59 libdeflate0 libembree4-4 libfmt10 libisal2 \
        libopencv-calib3d410 libopencv-core410 libopencv-imgcodecs410 libopencv-imgproc410 libopencv-ml410 libopenexr-3-1-30 \
        libopenimageio2.5 libpng16-16t64 libssl3t64 libtbb12 libtiff6 \
    && rm -rf /var/lib/apt/lists/* \
    && useradd --uid 1000 veldt \
    && install --directory --mode 1777 /data
COPY --from=build /installed/bin/veldt /usr/local/bin/veldt
COPY --from=build /installed/lib/veldt /usr/local/lib/veldt
COPY --from=build /installed/share/veldt /usr/local/share/veldt
# Whoever --user names has no folder of its own; Blender and fonts write to one.
ENV HOME=/tmp
USER 1000:1000
WORKDIR /data
ENTRYPOINT ["veldt"]
