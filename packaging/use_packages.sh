#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What tools/test-packages does with the packages in a tree of Debian: use_packages.sh STEP. The steps are the functions
# below, in their order.
set -eu

first=/packages/first
next=/packages/next
# What lies in homes is not the packages' own.
export HOME=/tmp

fail() {
    echo "test-packages: $1" >&2
    exit 1
}

apt_get() {
    apt-get -y -qq -o Dpkg::Use-Pty=0 "$@" >/packages/apt.log 2>&1 || fail "apt-get $*: $(cat /packages/apt.log)"
}

# Everything that is there but for what apt, dpkg and caches keep for themselves.
files() {
    find / -xdev \( -path /proc -o -path /packages -o -path /tmp -o -path /var/lib/apt -o -path /var/lib/dpkg \
        -o -path /var/cache -o -path /var/log \) -prune -o -print | sort
}

# The group render is udev's. systemd-sysusers makes it where udev is not installed, and it has nobody then.
users() {
    getent passwd
    getent group | grep -v '^render:[^:]*:[0-9]*:$'
}

# All that the packages need and recommend, so that only they make a difference later.
prepare() {
    apt-get update -qq
    for package in scipd scipd-tools; do
        apt_get satisfy "$(dpkg-deb -f $first/${package}_*.deb Depends Recommends |
            sed -n 's/^[A-Za-z]*: //p' | paste -sd, | sed 's/, scipd\(-tools\)\?//')"
    done
    for package in libscipd-dev python3-scipd; do
        apt_get satisfy --no-install-recommends "$(dpkg-deb -f $first/${package}_*.deb Depends)"
    done
    # What this test uses beside them.
    apt_get install --no-install-recommends cmake g++ make man-db bash-completion python3-pytest
    files >/packages/before
    users >/packages/users-before
}

install() {
    apt_get install $first/*.deb
    for package in scipd scipd-tools libscipd-dev python3-scipd; do
        [ "$(dpkg-query -W -f '${Status}' $package)" = 'install ok installed' ] || fail "$package is not installed"
    done
    for file in bash-completion/completions/scipctl zsh/vendor-completions/_scipcat fish/vendor_completions.d/scipd.fish; do
        [ -s /usr/share/$file ] || fail "/usr/share/$file is missing"
    done
    for page in scipd scipctl scipcat scipfit scipbench scipd.yaml; do
        man $page | grep -q 'SEE ALSO' || fail "man $page shows no page"
    done
    man -k scanner | grep -q '^scipd ' || fail "apropos does not find scipd"
    systemctl is-enabled -q scipd.service || fail "scipd.service is not enabled"
    getent passwd scipd >/dev/null || fail "there is no user scipd"
}

# start_scipd: runs it as its unit does, and waits until it listens.
start_scipd() {
    rm -f /tmp/ready
    mkdir -p /run/scipd
    chown scipd: /run/scipd
    setpriv --reuid scipd --regid scipd --clear-groups env RUNTIME_DIRECTORY=/run/scipd \
        scipd --config /etc/scipd/scipd.yaml >/tmp/ready 2>/tmp/log &
    scipd=$!
    for _ in $(seq 300); do
        if grep -qs '"ready":true' /tmp/ready; then return; fi
        kill -0 $scipd || fail "scipd ended: $(cat /tmp/log)"
        sleep 0.1
    done
    fail "scipd is not ready: $(cat /tmp/log)"
}

stop_scipd() {
    kill $scipd
    wait $scipd || fail "scipd ended with $?"
}

# The first answer of the page of scipd.yaml.
page() {
    bash -c 'exec 3<>/dev/tcp/127.0.0.1/10980
             printf "GET / HTTP/1.1\r\nHost: 127.0.0.1:10980\r\nConnection: close\r\n\r\n" >&3; cat <&3'
}

use() {
    scipd --check /etc/scipd/scipd.yaml || fail "the configuration has faults"
    scipd --probe >/tmp/probe || fail "scipd cannot draw with what it recommends: $(cat /tmp/probe)"
    start_scipd
    scipcat info tcp://127.0.0.1:10940 | grep -q UST-10LX || fail "scipcat info shows no scanner"
    scipcat info "$(readlink -f /run/scipd/rescue-front)" | grep -q UST-10LX || fail "there is no scanner on the tty"
    scipctl --control /run/scipd/control.sock status | grep -q rescue/front || fail "scipctl status shows no scanner"
    page | grep -q '<title>scipd' || fail "there is no live page"
    stop_scipd
    test_with_pytest
    scipbench compare --scene /usr/share/scipd/scenes/square_room.sdf --poses 3 --light | grep -q embree ||
        fail "scipbench compares nothing"
}

# As docs/testing.md has it, by the plugin that pytest finds itself.
test_with_pytest() {
    cat >/tmp/test_wall.py <<'END'
def test_it_sees_the_walls(scipd):
    daemon = scipd(world="/usr/share/scipd/scenes/square_room.sdf", accuracy="ideal")
    assert daemon.scan().at(0) == 3.0
END
    pytest -q -p no:cacheprovider /tmp/test_wall.py >/tmp/pytest || fail "pytest fails: $(cat /tmp/pytest)"
}

build_example() {
    cmake -S /usr/share/doc/libscipd-dev/examples -B /tmp/examples >/dev/null
    cmake --build /tmp/examples >/dev/null
    /tmp/examples/scan_a_room /usr/share/scipd/scenes/square_room.sdf | grep -q '3.000 m straight ahead' ||
        fail "the example casts no scan"
    start_scipd
    /tmp/examples/ask_scanner 127.0.0.1 10940 | grep -q '1081 ranges' || fail "the example gets no scan"
    stop_scipd
    rm -rf /tmp/examples
}

upgrade() {
    sed -i 's/UST-10LX/UST-20LX/' /etc/scipd/scipd.yaml
    apt_get install $next/*.deb
    dpkg-query -W -f '${Version}' scipd | grep -q -- '-2$' || fail "scipd was not upgraded"
    grep -q 'model: UST-20LX' /etc/scipd/scipd.yaml || fail "the upgrade has changed the configuration"
    start_scipd
    scipcat info tcp://127.0.0.1:10940 | grep -q UST-20LX || fail "the upgraded scipd does not run the configuration"
    stop_scipd
}

purge() {
    # As docs/service.md advises for those who are to use the ttys.
    gpasswd -a daemon scipd >/dev/null
    apt_get remove scipd
    grep -q 'model: UST-20LX' /etc/scipd/scipd.yaml || fail "removing it without purging takes the configuration away"
    apt_get purge scipd scipd-tools libscipd-dev python3-scipd
    files >/packages/after
    diff /packages/before /packages/after || fail "the packages leave files behind"
    users | diff /packages/users-before - || fail "the packages leave a user behind"
}

main_pid() {
    systemctl show -P MainPID scipd.service
}

# answers MODEL: the service runs and its scanner is this one.
answers() {
    systemctl is-active -q scipd.service || fail "scipd.service does not run: $(journalctl -u scipd --no-pager -n 30)"
    scipcat info tcp://127.0.0.1:10940 | grep -q "$1" || fail "the service has no $1"
}

# In a tree that was booted: what becomes of the service.
serve() {
    apt_get install $first/*.deb
    answers UST-10LX
    before=$(main_pid)
    sed -i 's/UST-10LX/UST-20LX/' /etc/scipd/scipd.yaml
    systemctl reload scipd.service
    answers UST-20LX
    [ "$(main_pid)" = "$before" ] || fail "a reload starts the service again"
    apt_get install $next/*.deb
    answers UST-20LX
    [ "$(main_pid)" != "$before" ] || fail "the upgrade does not start the service again"
    apt_get remove scipd
    if systemctl is-active -q scipd.service; then fail "the service runs on without its package"; fi
    apt_get install $next/*.deb
    answers UST-20LX
    systemctl disable -q --now scipd.service
    apt_get install --reinstall $next/*.deb
    if systemctl is-active -q scipd.service; then fail "a service that was disabled runs after an upgrade"; fi
    apt_get purge scipd scipd-tools libscipd-dev python3-scipd
    left=$(
        find / -xdev \( -path /packages -o -path /var/cache \) -prune -o -name '*scipd*' -print
        find /run -name '*scipd*'
    )
    [ -z "$left" ] || fail "purged, the packages leave $left"
}

"$1"
