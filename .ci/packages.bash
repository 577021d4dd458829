# shellcheck shell=bash
# The commands ./angen wheel and ./angen package; `angen` sources this and has the functions that install and build.
# shellcheck disable=SC2154 # root: of `angen`

# A wheel for people without ROS, out of what ./angen build has built: the same programs. It is for Debian's Python, and
# for each PROGRAM, another version.
run_wheel() { # [--python PROGRAM ...] [--bare]
  local tree=$root/build-wheel prefix package pythons=() modules=()
  while [[ ${1-} == --python ]]; do
    "${2-}" -m venv --help >/dev/null 2>&1 || die "--python needs the program of a Python with venv, such as python3.13"
    pythons+=("$(command -v "$2")")
    shift 2
  done
  take_bare wheel "$@"
  cd "$root" || exit
  install package
  prepare
  rm -rf "$tree"
  prefix=$(sed -n 's/^CMAKE_INSTALL_PREFIX:[A-Z]*=//p' build/CMakeCache.txt)
  mkdir -p "$tree"
  touch "$tree/CATKIN_IGNORE"
  for package in angen_models angen_sim angen_tools angen_apps; do
    DESTDIR=$tree cmake -P "build/src/$package/cmake_install.cmake" >"$tree/log" 2>&1 || failed_by "$tree/log"
  done
  build_modules "${pythons[@]}"
  rm -f dist/angen-*.whl
  if ((${#pythons[@]})); then modules=(build/pythons/*.so); fi
  python3 .ci/wheel.py "$tree$prefix" dist "${modules[@]}"
  [[ ! $bare ]] || try_wheel
}

# The module angen for other versions of Python, in build/pythons; their pybind11 is PyPI's.
build_modules() { # PROGRAM...
  local program number=0 environments=()
  rm -rf build/pythons build/angen/venv*
  (($#)) || return 0
  for program in "$@"; do
    environments+=("$state/venv$((number += 1))")
    "$program" -m venv "${environments[-1]}" && "${environments[-1]}/bin/pip" install -q pybind11==2.13.6 >&2 ||
      die "pip could not install pybind11 for $program"
  done
  configure build "-DANGEN_PYTHONS=$(IFS=';' && printf %s "${environments[*]/%//bin/python}")"
  compile build angen_pythons
}

# Debian packages of what is committed, in a build of their own.
run_package() { # [--bare]
  local tree=$root/build-package source
  take_bare package "$@"
  cd "$root" || exit
  install package
  source=$tree/angen-$(version)
  mkdir -p "$source" dist
  touch "$tree/CATKIN_IGNORE"
  git archive HEAD | tar -x -C "$source"
  say "building Debian packages; the log is $tree/log"
  (cd "$source" && DEB_BUILD_OPTIONS="parallel=$(jobs) noautodbgsym" dpkg-buildpackage -b -us -uc -nc) \
    >"$tree/log" 2>&1 || failed_by "$tree/log"
  lintian --fail-on error --tag-display-limit 0 "$tree"/*.changes
  rm -f dist/*.deb
  mv "$tree"/*.deb dist
  printf '%s\n' dist/*.deb
  [[ ! $bare ]] || try_packages
}

take_bare() { # COMMAND [--bare]: sets `bare` to whether what is made is tried on a bare Debian 12
  bare=${2-}
  [[ ! $bare || $bare == --bare && $# == 2 ]] || die "$1 understands --bare, which tries it on a bare Debian 12"
}

failed_by() { # LOG
  tail -n 30 "$1" >&2
  die "packing failed; all of it is in $1"
}

as_root() { if ((EUID == 0)); then "$@"; else sudo "$@"; fi; }

apt='DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends'

# Homes and data of the wheel, in a Python without ROS, have the bytes of those of this checkout: on Debian 12, and on
# Debian 13 if the wheel is for its Python.
try_wheel() {
  local made='generate --days 1 --seed 3 --out' expected debian
  expected=$(mktemp -d)
  angen $made "$expected/data" >/dev/null && angen world home --seed 3 -o "$expected/home.world" >/dev/null
  for debian in bookworm trixie; do
    [[ $debian == bookworm || -e $(echo dist/angen-*cp313*.whl) ]] || continue
    as_root .ci/bare --debian $debian --with dist \
      "apt-get -q update && $apt install python3-venv && python3 -m venv /opt/angen" \
      '/opt/angen/bin/pip install ../with/angen-*.whl' \
      "/opt/angen/bin/angen $made data && /opt/angen/bin/angen world home --seed 3 -o home.world" \
      '/opt/angen/bin/angen plan home.world -o plan.png'
    diff -r "$expected/data" build-bare/root/root/angen/data &&
      cmp "$expected/home.world" build-bare/root/root/angen/home.world
    say "the wheel makes the same home and data on Debian's $debian as this checkout"
  done
  rm -r "$expected"
}

# apt install, a running building, and nothing that is left after purge.
try_packages() {
  as_root .ci/bare --with dist \
    "apt-get -q update && $apt install ../with/angen_*.deb ../with/python3-angen_*.deb ../with/ros-angen-msgs_*.deb &&
      ${run_until_ready//.\/angen/angen}" \
    "$apt purge --autoremove angen python3-angen ros-angen-msgs" \
    "! find / -xdev -path /root -prune -o -iname '*angen*' -print | grep -v '^/var/\(cache\|lib/dpkg\|log\)'"
}
