# Two stages: one that compiles, and an image of the daemon and the libraries it
# loads, nothing else. No shell, no package manager, not root.
FROM debian:trixie-slim AS build
RUN apt-get update && apt-get install -y --no-install-recommends \
        gcc libc6-dev make libmicrohttpd-dev libcjson-dev libpng-dev libjpeg62-turbo-dev libwebp-dev libisal-dev nettle-dev zlib1g-dev \
    && rm -rf /var/lib/apt/lists/*
WORKDIR /src
COPY Makefile README.md CHANGELOG.md ./
COPY core core
COPY server server
COPY clients clients
# The flags beside -O3 leave out what no code calls, tables for debuggers, and most of the list of relocations.
RUN make -j"$(nproc)" CFLAGS="-O3 -ffunction-sections -fdata-sections -fno-asynchronous-unwind-tables" \
        LDFLAGS="-s -Wl,--gc-sections -Wl,-z,pack-relative-relocs" build/zrasterd
# The daemon, and each library that it needs at the path where it looks for it.
RUN mkdir -p /image && cp build/zrasterd /image/zrasterd \
    && ldd build/zrasterd | grep -o '/[^ ]*' | xargs -I LIBRARY cp -L --parents LIBRARY /image/ \
    && mkdir -p /image/usr/share/doc/zraster \
    && server/deploy/container/packages.sh /image >/image/usr/share/doc/zraster/packages.txt
COPY LICENSE /image/usr/share/doc/zraster/

# docker build --target batch: the command instead of the daemon, for server/deploy/kubernetes/indexed-job.yaml.
FROM build AS build-batch
RUN make -j"$(nproc)" CFLAGS=-O3 LDFLAGS=-s build/zraster
RUN mkdir -p /batch && cp build/zraster /batch/zraster \
    && ldd build/zraster | grep -o '/[^ ]*' | xargs -I LIBRARY cp -L --parents LIBRARY /batch/
FROM scratch AS batch
COPY --from=build-batch /batch /
COPY LICENSE /usr/share/doc/zraster/
USER 65532:65532
ENTRYPOINT ["/zraster"]

FROM scratch
COPY --from=build /image /
USER 65532:65532
ENV ZRASTER_ADDRESS=0.0.0.0 ZRASTER_PORT=8080
EXPOSE 8080
HEALTHCHECK --interval=10s --timeout=3s CMD ["/zrasterd", "--health"]
STOPSIGNAL SIGTERM
ENTRYPOINT ["/zrasterd"]
