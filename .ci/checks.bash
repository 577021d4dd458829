# shellcheck shell=bash
# What ./angen test, coverage, tidy and docs do; `angen` sources this and has the functions that install and build.
# shellcheck disable=SC2154 # root, suites: of `angen`

summary=()
matched=0 # whether a test had the words in its name
suite() { # NAME COMMAND...
  local name=$1 began=$SECONDS verdict=ok
  shift
  printf '\n== %s\n' "$name"
  "$@" || verdict=FAILED
  summary+=("$(printf '%-14s  %-6s  %4d s' "$name" "$verdict" $((SECONDS - began)))")
}

report() { # fails where a suite has
  printf '%s\n' '' "${summary[@]}"
  [[ "${summary[*]}" != *FAILED* ]]
}

# --- suites; each is a function of the words that a test's name should have

check_clang_format() { # names each file that `clang-format -i FILE` would change
  local wrong
  wrong=$(find src bench tests \( -name '*.cpp' -o -name '*.h' \) -exec clang-format --dry-run {} + 2>&1 |
    sed -n 's/^\([^:]*\):[0-9]*:[0-9]*: warning: code should.*/\1/p' | sort -u)
  [[ -z $wrong ]] || { printf "%s\n" "not as clang-format -i would have it:" "$wrong" && false; }
}

check_flake8() { python3 -m flake8; }

check_mypy() { python3 -m mypy; }

check_ctest() { # [WORDS]
  local program ran=0 failed=0 filter="*${1:-}*"
  if [[ ! ${1:-} ]]; then
    timeout 900 ctest --test-dir "${tree:-build}" -j "$(jobs)" --output-on-failure --timeout 300
    return
  fi
  for program in "${tree:-build}"/tests/*_test; do
    [[ -x $program && $("$program" --gtest_list_tests --gtest_filter="$filter") ]] || continue
    ran=1 matched=1
    "$program" --gtest_brief=1 --gtest_filter="$filter" || failed=1
  done
  ((ran)) || printf 'no C++ test has "%s" in its name\n' "$1"
  return $failed
}

check_pytest() { # [WORDS]
  local code=0
  # A file's tests share a ROS master and a node; files are independent. Most of them wait for wall time.
  timeout 2400 python3 -m pytest -q -n "$(nproc)" --dist loadfile ${1:+-k "$1"} "${pytest_arguments[@]}" || code=$?
  if ((code != 5)); then
    matched=1
  elif [[ ${1:-} ]]; then
    code=0 # none has these words in its name; another suite's may
  fi
  return $code
}
pytest_arguments=(tests)

run_test() { # [-k WORDS] [--asan | --tsan] [SUITE...]
  local words='' sanitizer='' chosen=() name
  while (($#)); do
    case $1 in
      -k) (($# > 1)) || die "-k needs words of a test's name" && words=$2 && shift ;;
      --asan | --tsan) sanitizer=${1#--} ;;
      *)
        [[ " $suites " == *" $1 "* ]] || die "no suite is named $1; there are: $suites"
        chosen+=("$1")
        ;;
    esac
    shift
  done
  cd "$root" || exit
  [[ ! $sanitizer ]] || { run_sanitized "$sanitizer" "$words" "${chosen[@]}"; return; }
  if ((${#chosen[@]} == 0)); then
    if [[ $words ]]; then chosen=(ctest pytest); else read -ra chosen <<<"$suites"; fi
  fi
  if [[ " ${chosen[*]} " == *test* ]]; then prepare test; else install test; fi
  for name in "${chosen[@]}"; do
    suite "$name" "check_${name//-/_}" "$words"
  done
  [[ ! $words ]] || ((matched)) || die "no test has \"$words\" in its name"
  report
}

# --- builds of their own

build_tree() { # FOLDER OPTIONS... -- TARGETS...: outside of build/, with a devel space of its own
  local folder=$root/$1 options=()
  shift
  while [[ $1 != -- ]]; do options+=("$1") && shift; done
  mkdir -p "$folder"
  [[ -e $folder/build.ninja ]] || configure "$folder" "-DCATKIN_DEVEL_PREFIX=$folder/devel" "${options[@]}"
  compile "$folder" "${@:2}"
}

# The C++ tests, and the node in the tests of tests/ros. Python is not instrumented, nor what it imports.
run_sanitized() { # asan|tsan WORDS [SUITE...]
  local tree=build-$1 flags name chosen=("${@:3}")
  ((${#chosen[@]})) || chosen=(ctest pytest)
  case $1 in
    asan) flags="-fsanitize=address,undefined -fno-sanitize-recover=undefined" ;;
    tsan) flags="-fsanitize=thread" ;;
  esac
  prepare test
  locked build_tree "$tree" "-DCMAKE_CXX_FLAGS=$flags -fno-omit-frame-pointer" -- angen_run tests
  # Each program finds the libraries of its own build by its RUNPATH, which LD_LIBRARY_PATH would overrule.
  unset LD_LIBRARY_PATH
  export CMAKE_PREFIX_PATH=$root/$tree/devel:$CMAKE_PREFIX_PATH
  export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 TSAN_OPTIONS=exitcode=66
  pytest_arguments=(tests/ros)
  for name in "${chosen[@]}"; do
    suite "$1 $name" "check_$name" "$2"
  done
  report
}

run_coverage() {
  local tree=build-coverage
  cd "$root" || exit
  install dev
  prepare
  locked build_tree "$tree" -DCMAKE_BUILD_TYPE=Coverage "-DCMAKE_CXX_FLAGS=--coverage -O1" -- all tests
  find "$tree" -name '*.gcda' -delete
  set +u
  source "$tree/devel/setup.bash"
  set -u
  pytest_arguments=(tests --cov=angen_tools "--cov-report=html:$tree/python" --cov-report=term)
  suite ctest check_ctest
  suite pytest check_pytest
  suite gcovr gcovr --root . --object-directory "$tree" --filter src/angen_sim/ --exclude-unreachable-branches \
    --html-details "$tree/cpp.html" --print-summary --output "$tree/cpp.txt"
  say "by line: $tree/cpp.html (C++), $tree/python/index.html"
  report
}

# clang-tidy sees each source by itself, with neither precompiled headers nor its neighbors: it finds what is not included.
run_tidy() { # [FILE...]
  local tree=build-tidy files=("$@")
  cd "$root" || exit
  install dev
  locked build_tree "$tree" -DCMAKE_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -- \
    angen_msgs_generate_messages_cpp gazebo_msgs_generate_messages_cpp
  ((${#files[@]})) || files=("$root/src/angen_sim/")
  suite clang-tidy run-clang-tidy -quiet -p "$tree" -j "$(jobs)" \
    -extra-arg=-Wno-unknown-warning-option "${files[@]}"
  report
}

run_docs() {
  cd "$root" || exit
  install dev
  mkdir -p build
  (cat Doxyfile && printf 'PROJECT_NUMBER = %s\n' "$(version)") | doxygen - >build/doxygen.log || die "doxygen failed; see build/doxygen.log"
  say "build/doxygen/html/index.html"
}
