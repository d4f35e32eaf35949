#!/bin/sh
# Installs packages in one layer, from the mirror $APT_MIRROR if it is set (it is not kept), and
# removes apt's lists, packages, caches and logs. $MAN_OF: packages of a slim base to restore man pages of.
set -eu
# apt reads only the lower-case names
export http_proxy="${http_proxy:-${HTTP_PROXY:-}}" https_proxy="${https_proxy:-${HTTPS_PROXY:-}}"
kept=/tmp/apt-sources
mkdir -p "$kept"
cp -a /etc/apt/. "$kept"
if [ -n "${APT_MIRROR:-}" ]; then
  find /etc/apt -name '*.list' -exec sed -i -E \
    "/packages\\.ros\\.org/!s#https?://[^ ]*/(debian|ubuntu)/?( |\$)#$APT_MIRROR\2#" {} +
  find /etc/apt -name '*.sources' -exec sed -i -E \
    "/packages\\.ros\\.org/!s#^(URIs: *)https?://[^ ]*/(debian|ubuntu)/?\$#\1$APT_MIRROR#" {} +
fi
apt-get update
DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@"
if [ -n "${MAN_OF:-}" ]; then
  pages=$(mktemp -d)
  cd "$pages"
  # shellcheck disable=SC2086 # a list of names
  apt-get -o APT::Sandbox::User=root download $MAN_OF
  for package in ./*.deb; do
    dpkg-deb -x "$package" unpacked
  done
  cp -a unpacked/usr/share/man/man[1-9]* /usr/share/man/
  cd /
  rm -rf "$pages"
  mandb --quiet
fi
rm -rf /etc/apt /var/lib/apt/lists/* /var/cache/apt/*.bin /var/cache/apt/archives/*.deb /var/log/apt /var/log/dpkg.log
mv "$kept" /etc/apt
