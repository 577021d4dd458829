# shellcheck shell=bash
# The commands ./angen test, fuzz, coverage, tidy and docs; `angen` sources this and has the functions that install and build.
# shellcheck disable=SC2154 # root, suites: of `angen`

summary=()
matched=0 # whether a test had the words in its name
suite() { # NAME COMMAND...
  local name=$1 began=$SECONDS verdict=ok seconds
  shift
  printf '\n== %s\n' "$name"
  "$@" || verdict=FAILED
  seconds=$((SECONDS - began))
  [[ ! -e $said/$name.seconds ]] || seconds=$(<"$said/$name.seconds")
  summary+=("$(printf '%-14s  %-6s  %4d s' "$name" "$verdict" "$seconds")")
}

# Suites of one process run side by side; the lines of each are printed at its turn.
single=" clang-format flake8 mypy tsc catkin-lint "
declare -A begun=() # process of each, with the id of its group
said=               # folder with the lines of each
timed() { # NAME WORDS
  local began=$SECONDS code=0
  "check_${1//-/_}" "$2" || code=$?
  echo $((SECONDS - began)) >"$said/$1.seconds"
  return $code
}

begin() { # NAME WORDS
  [[ -z ${begun[$1]:-} ]] || return 0 # given twice
  set -m # a group of its own
  timed "$@" >"$said/$1" 2>&1 </dev/null &
  begun[$1]=$!
  set +m
}

finish() { # NAME
  local code=0
  wait "${begun[$1]}" || code=$?
  unset "begun[$1]"
  cat "$said/$1"
  return $code
}

end_begun() { # also if Ctrl-C ends the tests
  local process
  for process in "${begun[@]}"; do kill -- "-$process" 2>/dev/null || true; done
  rm -rf "$said"
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

check_catkin_lint() { catkin_lint --offline -W2 src; } # packages as catkin and rosdep expect them

check_tsc() { tsc -p src/angen_apps/jsconfig.json; } # types of the page's JavaScript, as its comments say

check_ctest() { # [WORDS]
  local program ran=0 failed=0 filter="*${1:-}*"
  if [[ ! ${1:-} ]]; then
    timeout $((900 * slowness)) ctest --test-dir "${tree:-build}" -j "$(jobs)" --output-on-failure --timeout $((300 * slowness))
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
  # Many tests wait for wall time: more workers than processors. tests/conftest.py lists the tests that share a worker.
  timeout $((2400 * slowness)) env ${preloaded:+"LD_PRELOAD=$preloaded"} python3 -m pytest -q -n $(($(nproc) + extra_workers)) --dist loadfile --durations=10 ${1:+-k "$1"} "${pytest_arguments[@]}" || code=$?
  if ((code != 5)); then
    matched=1
  elif [[ ${1:-} ]]; then
    code=0 # none has these words in its name; another suite's may
  fi
  return $code
}
pytest_arguments=(tests)
extra_workers=2
preloaded= # libraries, before Python's own
slowness=1 # by which a build of its own multiplies limits of time

run_test() { # [-k WORDS] [--asan | --tsan | --bare] [SUITE...]
  local words='' sanitizer='' bare='' chosen=() name
  while (($#)); do
    case $1 in
      -k) (($# > 1)) || die "-k needs words of a test's name" && words=$2 && shift ;;
      --asan | --tsan) sanitizer=${1#--} ;;
      --bare) bare=1 ;;
      *)
        [[ " $suites " == *" $1 "* ]] || die "no suite is named $1; there are: $suites"
        chosen+=("$1")
        ;;
    esac
    shift
  done
  cd "$root" || exit
  [[ ! $bare ]] || { run_bare "$words" "${chosen[@]}"; return; }
  [[ ! $sanitizer ]] || { run_sanitized "$sanitizer" "$words" "${chosen[@]}"; return; }
  if ((${#chosen[@]} == 0)); then
    if [[ $words ]]; then chosen=(ctest pytest); else read -ra chosen <<<"$suites"; fi
  fi
  if [[ " ${chosen[*]} " == *test* ]]; then prepare test; else install test; fi
  said=$(mktemp -d)
  trap end_begun EXIT
  for name in "${chosen[@]}"; do
    [[ $single != *" $name "* ]] || begin "$name" "$words"
  done
  for name in "${chosen[@]}"; do
    if [[ ${begun[$name]:-} ]]; then suite "$name" finish "$name"; else suite "$name" "check_${name//-/_}" "$words"; fi
  done
  [[ ! $words ]] || ((matched)) || die "no test has \"$words\" in its name"
  report
}

# --- a bare machine

# The commands of the README that every newcomer runs, on a bare Debian 12; Ctrl-C ends the building when it runs.
run_bare() { # WORDS [SUITE...]
  local sudo=()
  ((EUID == 0)) || sudo=(sudo)
  install dev
  "${sudo[@]}" .ci/bare "$run_until_ready" "./angen test ${1:+-k ${1@Q}} ${*:2}"
}
run_until_ready='set -m; ./angen run > >(tee /tmp/log) 2>&1 & running=$!
  until grep -qs " models, " /tmp/log; do kill -0 $running || exit 1; sleep 1; done
  kill -INT $running; wait $running; [[ $? == 130 ]]'

# --- builds of their own

build_tree() { # FOLDER OPTIONS... -- TARGETS...: outside of build/, with a devel space of its own
  local folder=$root/$1 options=()
  shift
  while [[ $1 != -- ]]; do options+=("$1") && shift; done
  mkdir -p "$folder"
  [[ -e $folder/build.ninja ]] || configure "$folder" "-DCATKIN_DEVEL_PREFIX=$folder/devel" "${options[@]}"
  compile "$folder" "${@:2}"
}

# A sanitizer's tree; core and load alone take two minutes, all of it with the node ten.
sanitized_tree() { # asan|tsan TARGETS...
  local flags
  case $1 in
    asan) flags='-fsanitize=address,undefined -fno-sanitize-recover=all' ;;
    tsan) flags='-fsanitize=thread' ;;
  esac
  locked build_tree "build-$1" -DCMAKE_BUILD_TYPE=Sanitized '-DCMAKE_CXX_FLAGS_SANITIZED=-O1 -g1' \
    "-DCMAKE_CXX_FLAGS=$flags -fno-omit-frame-pointer" -- "${@:2}"
}

# The files of tests/sanitizers list findings in libraries of others. Programs are built while these
# options hold: angen_describe runs after each plug-in.
sanitizer_options() {
  local lists=$root/tests/sanitizers
  export ASAN_OPTIONS=detect_leaks=0:quarantine_size_mb=64 UBSAN_OPTIONS=print_stacktrace=1
  export TSAN_OPTIONS=exitcode=66:history_size=4:suppressions=$lists/tsan.txt
}

# Unit tests of the readers of files, under AddressSanitizer and UndefinedBehaviorSanitizer; part of each ./angen test.
check_asan() { # [WORDS]
  local program failed=0
  (sanitizer_options && sanitized_tree asan core_test document_test assets_test import_test sdf_test) || return
  for program in core document assets import sdf; do
    (sanitizer_options && "build-asan/tests/${program}_test" --gtest_brief=1 --gtest_filter="*${1:-}*") || failed=1
    [[ ! $(sanitizer_options && "build-asan/tests/${program}_test" --gtest_list_tests --gtest_filter="*${1:-}*") ]] || matched=1
  done
  return $failed
}

# The C++ tests, and the node and `import angen` in those of Python. Python itself is not instrumented.
run_sanitized() { # asan|tsan WORDS [SUITE...]
  local tree=build-$1 name chosen=("${@:3}") slowness=4 extra_workers=0
  ((${#chosen[@]})) || chosen=(ctest pytest)
  install test
  prepare
  sanitizer_options
  sanitized_tree "$1" all tests
  # Each program finds the libraries of its own build by its RUNPATH, which LD_LIBRARY_PATH would overrule.
  unset LD_LIBRARY_PATH
  export CMAKE_PREFIX_PATH=$root/$tree/devel:$CMAKE_PREFIX_PATH ANGEN_TEST_TREE=$tree
  # Python loads instrumented libraries only if the sanitizer's library is loaded already.
  export PYTHONPATH=$root/$tree/devel/lib/python3/dist-packages:$PYTHONPATH
  preloaded=$(g++ -print-file-name="lib$1.so"):$(g++ -print-file-name=libstdc++.so)
  pytest_arguments=(tests/ros)
  if [[ $1 == asan ]]; then # ThreadSanitizer has nothing to find in tests/py: they have one thread
    export PYTHONMALLOC=malloc
    pytest_arguments+=(tests/py)
  fi
  for name in "${chosen[@]}"; do
    suite "$1 $name" "check_$name" "$2"
  done
  report
}

# --- fuzzing

run_fuzz() { # [TARGET...] [--seconds N | --runs N]
  local tree=build-fuzz limit=-max_total_time=60 chosen=() known name
  cd "$root" || exit
  known=$(find tests/fuzz/corpus -mindepth 1 -maxdepth 1 -printf '%f\n' | sort)
  while (($#)); do
    case $1 in
      --seconds | --runs)
        [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || die "$1 needs a whole number above 0"
        if [[ $1 == --runs ]]; then limit=-runs=$2; else limit=-max_total_time=$2; fi
        shift
        ;;
      *)
        grep -qxF -- "$1" <<<"$known" || die "no target is named $1; there are: ${known//$'\n'/ }"
        chosen+=("$1")
        ;;
    esac
    shift
  done
  ((${#chosen[@]})) || mapfile -t chosen <<<"$known"
  install fuzz
  sanitizer_options
  locked build_tree "$tree" -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DANGEN_FUZZ=ON \
    -DCMAKE_BUILD_TYPE=Sanitized '-DCMAKE_CXX_FLAGS_SANITIZED=-O1 -g1' \
    "-DCMAKE_CXX_FLAGS=-w -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize=vptr -fno-sanitize-recover=all \
-fsanitize-ignorelist=$root/tests/sanitizers/clang.txt" \
    -- angen_fuzz
  mkdir -p "$tree"/{corpus,found,logs}
  for name in "${chosen[@]}"; do
    suite "fuzz $name" fuzz_target "$tree" "$name" "$limit"
  done
  report
}

# Finds crashes, inputs of more than 5 s, and of more than 1 GB; new inputs are kept in the tree.
fuzz_target() { # TREE NAME LIMIT
  local log=$1/logs/$2 code=0 seeds=("tests/fuzz/corpus/$2" "$1/models/$2") runs
  mkdir -p "$1/corpus/$2" "$1/models/$2"
  write_models "$2" "$1/models/$2"
  { printf '"angen"\n' && words_of "${seeds[@]}"; } >"$1/corpus/$2.dict" # libFuzzer takes no empty one
  ANGEN_FUZZ_TARGET=$2 "$1/tests/angen_fuzz" "$3" -timeout=5 -rss_limit_mb=1024 -detect_leaks=0 -max_len=8192 \
    -print_final_stats=1 -dict="$1/corpus/$2.dict" -artifact_prefix="$1/found/$2-" "$1/corpus/$2" "${seeds[@]}" \
    >"$log" 2>&1 || code=$?
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  printf '%s executions, %s inputs kept\n' "${runs:-unknown}" "$(find "$1/corpus/$2" -type f | wc -l)"
  printf '%s %s %s\n' "$2" "${runs:-0}" "$code" >>"$1/executions"
  ((code == 0)) || { grep -aE '^(SUMMARY|broken promise|==[0-9]+==ERROR|Test unit written)' "$log"; say "see $log"; }
  return $code
}

# The models of worlds/ as inputs of `urdf` and, in a world, of `sim`; on one line, as 8 kB of an input count.
write_models() { # TARGET FOLDER
  local model world=('' '')
  case $1 in
    urdf) ;;
    sim) world=('<world name="w">' '</world>') ;;
    *) return ;;
  esac
  for model in worlds/models/*/model.sdf; do
    tr -s ' \n' ' ' <"$model" | sed "s|<sdf[^>]*>|&${world[0]}|; s|</sdf>|${world[1]}&|" >"$2/$(basename "${model%/*}")"
  done
}

# The words of a target's seeds, as libFuzzer's dictionary.
words_of() { # FOLDER...
  find "$@" -type f -exec grep -aohE '</?[A-Za-z_:]+|[A-Za-z_]{2,30}=?' {} + | sort -u | sed -n '1,600s/.*/"&"/p'
}

run_coverage() { # [--floor CPP PYTHON]: fails where a smaller share of the lines (%) is run
  local tree=build-coverage floors=(0 0)
  if (($#)); then
    [[ $1 == --floor && $# == 3 && "$2 $3" =~ ^[0-9]+\ [0-9]+$ ]] ||
      die "coverage understands --floor CPP PYTHON, two whole numbers in %"
    floors=("$2" "$3")
  fi
  cd "$root" || exit
  install dev
  prepare
  locked build_tree "$tree" -DCMAKE_BUILD_TYPE=Coverage "-DCMAKE_CXX_FLAGS=--coverage -fprofile-update=atomic -O1" -- all tests
  find "$tree" -name '*.gcda' -delete
  set +u
  source "$tree/devel/setup.bash"
  set -u
  pytest_arguments=(tests --cov=angen_models --cov=angen_tools --cov=angen_apps --cov=angen_bench "--cov-report=html:$tree/python" --cov-report=term
    "--cov-fail-under=${floors[1]}")
  suite ctest check_ctest
  suite pytest check_pytest
  suite gcovr gcovr --root . --object-directory "$tree" --filter src/angen_ --exclude-unreachable-branches \
    --html-details "$tree/cpp.html" --print-summary --output "$tree/cpp.txt" --fail-under-line "${floors[0]}"
  say "by line: $tree/cpp.html (C++), $tree/python/index.html"
  report
}

# clang-tidy compiles each source by itself, without precompiled headers or its neighbors: it finds missing includes.
run_tidy() { # [FILE...]
  local tree=build-tidy files=("$@")
  cd "$root" || exit
  install dev
  locked build_tree "$tree" -DCMAKE_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -- \
    angen_msgs_generate_messages_cpp gazebo_msgs_generate_messages_cpp kobuki_msgs_generate_messages_cpp
  ((${#files[@]})) || files=("$root/src/angen_sim/" "$root/src/angen_gazebo/")
  suite clang-tidy run-clang-tidy -quiet -p "$tree" -j "$(jobs)" \
    -extra-arg=-Wno-unknown-warning-option "${files[@]}"
  report
}

# Each version has its folder, so that a server keeps those of releases side by side.
build_site() { # VERSION
  ANGEN_VERSION=$1 sphinx-build -q -W --keep-going -E -c docs/site . "build/site/$1" 2>build/site.log ||
    die "sphinx failed: $(<build/site.log)"
  printf '<meta http-equiv="refresh" content="0; url=%s/README.html">\n' "$1" >build/site/index.html
  say "build/site/index.html"
}

run_docs() {
  cd "$root" || exit
  if [[ ${1:-} == --pictures ]]; then
    prepare
    exec python3 docs/pictures.py "${@:2}"
  fi
  install dev
  mkdir -p build
  (cat Doxyfile && printf 'PROJECT_NUMBER = %s\n' "$(version)") | doxygen - >build/doxygen.log || die "doxygen failed; see build/doxygen.log"
  say "build/doxygen/html/index.html"
  build_site "$(version)"
}
