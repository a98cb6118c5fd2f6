# SPDX-License-Identifier: Apache-2.0
# docker build -t floorproof . && docker run --rm -v "$PWD:/work" floorproof demo
FROM debian:bookworm-slim
RUN apt-get update \
 && apt-get install -y --no-install-recommends bash ca-certificates git python3 \
 && rm -rf /var/lib/apt/lists/*
WORKDIR /opt/floorproof
# Packages and MuJoCo first: this layer lasts as long as the launcher does not change.
COPY floorproof ./
RUN ./floorproof setup && rm -rf /var/lib/apt/lists/*
COPY . .
RUN ./floorproof --version
WORKDIR /work
ENTRYPOINT ["/opt/floorproof/floorproof"]
CMD ["--help"]
