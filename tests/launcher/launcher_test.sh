#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# launcher_test.sh CASE: runs the launcher in a small tree of its own, with stand-ins for cmake,
# ctest, dpkg-query, apt-get and pip that write down how they were called. No network, no compiler.
# shellcheck disable=SC2317  # the cases are called by name
set -u
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tree="$work/with ü & space"
dut="$tree/floorproof"
failures=0
as_user=(env)

expect() {  # expect WHAT COMMAND...: COMMAND must succeed
  local what=$1
  shift
  "$@" && return
  echo "FAILED: $what"
  echo "--- stdout"; cat "$work/out"; echo "--- stderr"; cat "$work/err"
  echo "--- calls"; cat "$work/calls"
  failures=$((failures + 1))
}
# run ARGUMENT...: starts the launcher; leaves $status, $work/out and $work/err.
run() {
  "${as_user[@]}" "$dut" "$@" >"$work/out" 2>"$work/err"
  status=$?
}
says() { grep -qF -- "$2" "$work/$1"; }
calls() { grep -c -- "^$1" "$work/calls"; }
stub() {  # stub NAME: a command from stdin
  cat >"$work/bin/$1"
  chmod +x "$work/bin/$1"
}

# A tree whose "build" is a copied script.
mkdir -p "$tree"/{apps,base,cmake,controllers,env,measure,media,planners,render,report,run,stats,validate,web,tests} "$work/bin"
cp "$here/../../floorproof" "$dut"
touch "$tree/CMakeLists.txt" "$tree/apps/main.cc" "$work/calls"
export WORK=$work PATH="$work/bin:$PATH"
unset FLOORPROOF_MUJOCO_DIR FLOORPROOF_APT CXX
umask 022
stub cmake <<'STUB'
#!/usr/bin/env bash
echo "cmake $*" >>"$WORK/calls"
if [[ $1 == -S ]]; then
  build=$2/build/release
  mkdir -p "$build"
  printf 'CMAKE_HOME_DIRECTORY:INTERNAL=%s\nFLOORPROOF_MUJOCO_DIR:PATH=%s\n' "$2" "${!##*DIR=}" \
    >"$build/CMakeCache.txt"
  touch "$build/build.ninja"
  exit
fi
trap 'exit 2' INT  # as ninja does
sleep "${BUILD_SECONDS:-0}"
[[ -z ${BUILD_FAILS:-} ]] || { echo "main.cc:7: error: no such thing"; exit 1; }
mkdir -p "$2/bin"
printf '#!/bin/bash\npwd; printf "[%%s]" "$@"; exit 4\n' >"$2/bin/floorproof"
chmod +x "$2/bin/floorproof"
STUB
stub ninja <<<'#!/bin/bash'
stub g++ <<<'#!/bin/bash'
stub ctest <<'STUB'
#!/bin/bash
echo "ctest $*" >>"$WORK/calls"
exit "${CTEST_STATUS:-0}"
STUB
stub dpkg-query <<'STUB'
#!/bin/bash
for package in "${@:4}"; do
  [[ $package == "${ABSENT:-}" && ! -f $WORK/installed ]] || echo "$package installed"
done
STUB
stub dpkg <<<'#!/bin/bash'
stub apt-cache <<<'#!/bin/bash'
stub apt-get <<'STUB'
#!/bin/bash
[[ " $* " == *" --print-uris "* ]] && { echo "'http://x/y' y 2500000 SHA256:0"; exit; }
echo "apt-get $*" >>"$WORK/calls"
[[ " $* " != *" install "* ]] || touch "$WORK/installed"
STUB
stub python3 <<'STUB'
#!/usr/bin/env bash
echo "python3 $*" >>"$WORK/calls"
[[ $1 != -I ]] || shift
if [[ $1 == -c && $2 == *version_info* ]]; then exit "${PYTHON_IS_OLD:-0}"; fi
if [[ $1 == -c && $2 == "import markdown_it" ]]; then [[ -f $WORK/installed ]]; exit; fi
[[ $1 != *build.py ]] || exit "${LINKS_ARE_BROKEN:-0}"
if [[ $1 == --version ]]; then echo "Python 3.10.1"; exit; fi
if [[ $1 == -c ]]; then  # whether it has all that a package needs
  [[ -z ${PYTHON_IS_BARE:-} || -f $WORK/installed ]]
  exit
fi
if [[ $1 == -m && $2 == venv ]]; then
  mkdir -p "$3/bin"
  printf '#!/bin/bash\necho "venv python $*" >>"$WORK/calls"\n[[ $2 != pytest ]] || exit "${PYTEST_STATUS:-0}"\n' \
    >"$3/bin/python"
  chmod +x "$3/bin/python"
  exit
fi
[[ $1 != - || $3 != */web ]] || mkdir -p "$3"
[[ $1 != - || $3 != */mujoco ]] || { mkdir -p "$3/include/mujoco"; touch "$3/include/mujoco/mujoco.h" "$3/libmujoco.so.4.0.1"; }
STUB

# --- cases ---------------------------------------------------------------------------------------

starts_at_once() {
  run demo
  expect "the first start announces the wheel" says err "10 MB from PyPI"
  expect "and the libraries of pages" says err "three.js, ECharts and AG Grid, checked by hash"
  expect "a pip.py in the caller's folder is not what runs" \
    test "$(grep '^python3 ' "$work/calls" | grep -cv '^python3 -I ')" = 0
  expect "the wheel is pinned" grep -q -- "pip download.*--require-hashes.*cp311" "$work/calls"
  : >"$work/calls"
  if ((EUID == 0)); then  # another user than the one who built it
    chmod a+rx "$work"
    as_user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
  fi
  cd / && run run "a b" '' --x
  expect "the program's status is the launcher's" test "$status" = 4
  expect "the caller's folder and arguments arrive unchanged" test "$(<"$work/out")" = $'/\n[run][a b][][--x]'
  expect "a second start says nothing" test ! -s "$work/err"
  expect "a second start calls nothing" test ! -s "$work/calls"
}

tests_the_python_package() {
  echo 'test = ["pytest"]' >"$tree/pyproject.toml"
  run test --python -k some
  expect "its tests decide" test "$status" = 0
  expect "the program is built first" test "$(calls 'cmake --build')" = 2
  expect "the extension is linked from what is compiled" grep -q -- "cmake -S.*FLOORPROOF_PYTHON=ON" "$work/calls"
  expect "the wheel is made of it" grep -q "venv python.*pip install.*FLOORPROOF_BUILT_IN=$tree/build/release" "$work/calls"
  expect "pytest gets the arguments" grep -qx "venv python -m pytest -k some" "$work/calls"
  : >"$work/calls"
  PYTEST_STATUS=1 run test --python
  expect "a test that fails is status 1" test "$status" = 1
  expect "the environment stays" test "$(grep -c "python3 -I -m venv" "$work/calls")" = 0
  PYTEST_STATUS=5 run test --python
  expect "no test at all is status 1" test "$status" = 1
  echo '# changed' >>"$tree/pyproject.toml"
  : >"$work/calls"
  PYTHON_IS_BARE=1 run test --python
  if ((EUID == 0)); then
    expect "what Python lacks is installed" grep -q "apt-get.*install.*python3-venv python3-dev" "$work/calls"
    expect "other wants are another environment" test "$(grep -c "python3 -I -m venv" "$work/calls")" = 1
  else
    expect "what Python lacks is asked for" says err "python3-venv python3-dev"
  fi
  PYTHON_IS_OLD=1 run test --python
  expect "a Python that is too old is named" test "$status" = 2
  expect "with its version" says err "3.11 or later, as MuJoCo's wheel does; python3 is Python 3.10.1"
}

builds_the_pages() {
  # The machine's commands but for its Pythons, of which any may be able to read Markdown.
  mkdir "$work/commands"
  ln -s /bin/* /usr/bin/* "$work/commands" 2>/dev/null
  rm -f "$work"/commands/python3*
  export PATH="$work/bin:$work/commands"
  FLOORPROOF_APT=0 run docs
  expect "without apt what is missing is named" says err "docs needs Python's markdown-it-py"
  expect "as bad usage" test "$status" = 2
  run docs
  if ((EUID == 0)); then
    expect "the package is installed, and no other" \
      grep -qx -- "apt-get.* install .*--no-install-recommends python3-markdown-it" "$work/calls"
  else
    expect "the package is asked for" says err "--no-install-recommends python3-markdown-it"
    touch "$work/installed"
    run docs
  fi
  expect "the pages are made" grep -qx "python3 -I $tree/docs/site/build.py $tree $tree/build/docs" "$work/calls"
  expect "nothing is fetched, configured or built" test "$(grep -cE 'pip|cmake' "$work/calls")" = 0
  : >"$work/calls"
  cd / && run docs --out "some where"
  expect "--out is the caller's" grep -qx "python3 -I $tree/docs/site/build.py $tree some where" "$work/calls"
  expect "what is there is not installed again" test "$(calls apt-get)" = 0
  LINKS_ARE_BROKEN=1 run docs
  expect "a link that leads nowhere is status 1" test "$status" = 1
  run docs --uot x
  expect "anything else is bad usage" test "$status" = 2
  expect "in a line" says err "docs takes --out DIR and nothing else"
}

installs_a_link() {
  export HOME="$work/a home"
  mkdir "$HOME"
  run install
  expect "a link is made" test "$status" = 0 -a "$(readlink "$HOME/.local/bin/floorproof")" = "$dut"
  expect "a folder off the PATH is told of" says err "is not on your PATH"
  expect "nothing is built for it" test ! -s "$work/calls"
  export PATH="$HOME/.local/bin:$PATH"
  run install
  expect "again is as once" test "$status" = 0
  expect "a folder on the PATH is not told of" test "$(grep -c "not on your PATH" "$work/err")" = 0
  cd / && floorproof demo >"$work/out" 2>"$work/err"
  expect "the link starts the program" grep -qF "[demo]" "$work/out"
  rm "$HOME/.local/bin/floorproof"
  echo mine >"$HOME/.local/bin/floorproof"
  run install
  expect "what is no link stays" test "$status" = 2 -a "$(<"$HOME/.local/bin/floorproof")" = mine
  run install --help
  expect "an argument is refused" test "$status" = 2
  expect "and what it does is said" says err "install takes no argument"
}

rebuilds_what_changed() {
  run demo
  : >"$work/calls"
  touch "$tree/models.xml" "$tree/tests/x_test.cc"
  run demo
  expect "models and tests are no part of the program" test "$(calls cmake)" = 0
  # Each folder of which the program is made.
  read -ra folders < <(tr '\n' ' ' <"$here/../../CMakeLists.txt" | grep -o 'foreach(folder [^)]*' |
    sed 's/foreach(folder//')
  expect "the folders are known" test "${#folders[@]}" -gt 20
  local before=0
  for folder in "${folders[@]}"; do
    mkdir -p "$tree/$folder"
    touch "$tree/$folder/new.h"
    run demo
    expect "a new source of $folder is built" test "$(calls 'cmake --build')" = $((before + 1))
    before=$(calls 'cmake --build')
  done
  expect "without configuring again" test "$(calls 'cmake -S')" = 0
  expect "nor fetching again" test "$(calls python3)" = 0
}

follows_links() {
  mkdir "$work/some where"
  ln -s "$dut" "$work/some where/one"
  ln -s one "$work/some where/two"
  cd "$work/some where" || exit
  dut=./two run list
  expect "started through two links" says out "[list]"
  expect "built in its own tree" test -x "$tree/build/release/bin/floorproof"
}

asks_for_packages() {
  if ((EUID == 0)); then
    chmod -R a+rwX "$work"
    as_user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
  fi
  ABSENT=libyaml-cpp-dev run demo
  expect "ends with status 2" test "$status" = 2
  expect "prints the one line" says err "apt-get install -y --no-install-recommends libyaml-cpp-dev"
  expect "names the size" says err "3 MB"
  expect "installs, fetches and builds nothing" test "$(grep -cE 'install|download|cmake' "$work/calls")" = 0
}

installs_as_root() {
  ((EUID == 0)) || { echo "needs root: skipped"; exit 77; }
  ABSENT=libyaml-cpp-dev run demo
  expect "names the size before" says err "3 MB from your distribution"
  expect "installs what is missing and no more" \
    grep -q -- "apt-get.* install .*--no-install-recommends libyaml-cpp-dev$" "$work/calls"
  expect "then builds and starts" test "$status" = 4
}

reports_a_failed_build() {
  BUILD_FAILS=1 run demo
  expect "ends with status 3" test "$status" = 3
  expect "shows the compiler's words" says err "main.cc:7: error"
  expect "names the log" says err "build/build.log"
  BUILD_FAILS=1 run demo
  expect "the next start tries again" test "$status" = 3
  run demo
  expect "and succeeds once mended" test "$status" = 4
}

reports_failed_tests() {
  run test -R Spiral
  expect "passing tests: 0" test "$status" = 0
  expect "the quick ones, with the caller's arguments" \
    grep -q -- "^ctest .*-L ^quick\$ .*-R Spiral$" "$work/calls"
  expect "the slow ones are not built" grep -q -- '--target floorproof fp_quick_tests$' "$work/calls"
  run demo
  expect "the program is built with them" test "$(calls 'cmake --build')" = 1
  CTEST_STATUS=8 run test --all
  expect "--all builds the slow ones" grep -q -- 'fp_quick_tests fp_slow_tests$' "$work/calls"
  expect "failing tests: 1" test "$status" = 1
  expect "--all has no label" test "$(grep -c -- '^ctest .*-L' "$work/calls")" = 1
  expect "and is not passed on" test "$(grep -c -- '^ctest .*--all' "$work/calls")" = 0
  run test
  expect "nothing was built twice" test "$(calls 'cmake --build')" = 2
}

builds_once() {
  run setup
  BUILD_SECONDS=1 "$dut" one >"$work/out1" 2>&1 &
  sleep 0.3
  run two
  wait
  expect "one build for two starts" test "$(calls 'cmake --build')" = 1
  expect "the second waits and says so" says err "waiting"
  expect "both run" grep -q '\[one\]' "$work/out1"
  expect "both run" says out "[two]"
}

leaves_nothing_half_done() {
  # Job control gives the launcher a process group of its own, as a terminal's Ctrl-C needs.
  set -m
  BUILD_SECONDS=20 "$dut" demo >"$work/out" 2>"$work/err" &
  set +m
  for _ in {1..100}; do
    [[ $(calls 'cmake --build') == 0 ]] || break
    sleep 0.05
  done
  kill -INT -- -$!
  wait $!
  expect "interrupted: 130" test $? = 130
  expect "no stamp" test ! -e "$tree/build/release/.built-floorproof"
  expect "no temporary files" test -z "$(find "$tree/build" -name .began -o -name 'mujoco.??????' -o -name 'web.??????')"
  run demo
  expect "the next start finishes the work" test "$status" = 4
}

uses_a_given_mujoco() {
  mkdir -p "$work/mj/include/mujoco"
  FLOORPROOF_MUJOCO_DIR=$work/mj run demo
  expect "a folder without MuJoCo is bad usage" test "$status" = 2
  touch "$work/mj/include/mujoco/mujoco.h"
  export FLOORPROOF_WEB=0
  cd "$work" && FLOORPROOF_MUJOCO_DIR=mj run demo
  expect "it is configured, as an absolute path" grep -q -- "MUJOCO_DIR=$work/mj$" "$work/calls"
  : >"$work/calls"
  touch "$tree/env/new.h"
  run demo
  expect "and kept afterwards" test "$(calls 'cmake -S')" = 0
  expect "nothing is fetched" test "$(calls python3)" = 0
}

notices_a_moved_tree() {
  run demo
  mv "$tree" "$work/elsewhere"
  tree=$work/elsewhere dut=$work/elsewhere/floorproof
  run demo
  expect "configured for the new place" grep -q -- "^cmake -S $work/elsewhere" "$work/calls"
  expect "and started there" test "$status" = 4
}

declare -F "${1:-}" >/dev/null || { echo "no such case: ${1:-}"; exit 2; }
"$1"
exit $((failures != 0))
