# Angen on a bare Debian 12: docker build -t angen . && docker run --rm -it angen ./angen run
FROM debian:12
WORKDIR /angen
COPY . .
RUN ./angen build
ENTRYPOINT []
CMD ["./angen", "run"]
