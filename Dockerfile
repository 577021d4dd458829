# Angen on Debian 12: ./angen package && docker build -t angen . && docker run --rm -it angen
FROM debian:12
COPY dist/*.deb /packages/
RUN apt-get update && apt-get install -y --no-install-recommends /packages/*.deb && rm -rf /packages /var/lib/apt/lists/*
CMD ["angen", "run"]
