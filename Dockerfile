# Not run in this project's checks, which have no Docker: only its shell is checked (tests/packages).
#     docker build -t lobelia . && docker run --rm -v "$PWD:/data" -w /data lobelia compare a.exr b.exr
FROM debian:bookworm AS build
COPY . /src
WORKDIR /src
RUN tools/setup build packaging && make package SETUP=no

FROM debian:bookworm
COPY --from=build /src/build/release/packages/*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/liblobelia0_*.deb /tmp/lobelia_*.deb && rm -rf /tmp/*.deb /var/lib/apt/lists/*
USER nobody
ENTRYPOINT ["lobelia"]
