#!/bin/sh
# Inside the build: installs the package $1 and copies what runs of it, with exactly the libraries it needs, to $2.
set -eu
package=$1
root=$2

# Where its libraries are there already, nothing is fetched.
if ! dpkg -i "$package" >/tmp/install.log 2>&1; then
  apt-get update -q
  apt-get install -q -y --no-install-recommends -f
fi

# A file and all links it is reached by; /lib and /lib64 are links to /usr, one place for all.
keep() {
  file=$1
  while :; do
    real=$(readlink -f "$(dirname "$file")")/$(basename "$file")
    mkdir -p "$root$(dirname "$real")"
    [ -e "$root$real" ] || [ -L "$root$real" ] || cp -a "$real" "$root$real"
    [ -L "$real" ] || break
    case $(readlink "$real") in
      /*) file=$(readlink "$real") ;;
      *) file=$(dirname "$real")/$(readlink "$real") ;;
    esac
  done
}

for folder in usr/lib usr/lib64 usr/share var/lib run tmp etc/coop proc sys dev; do mkdir -p "$root/$folder"; done
ln -s usr/lib "$root/lib"
ln -s usr/lib64 "$root/lib64"
cp -a /usr/lib/coop "$root/usr/lib/coop"
mkdir "$root/usr/share/coop"
cp -a /usr/share/coop/config /usr/share/coop/maps "$root/usr/share/coop"

for program in /usr/lib/coop/*; do ldd "$program"; done >/tmp/ldd
if grep 'not found' /tmp/ldd; then exit 1; fi
# `name => /path (address)` for libraries, `/path (address)` for the loader.
awk '$3 ~ /^\// { print $3 } $1 ~ /^\// { print $1 }' /tmp/ldd | sort -u >/tmp/libraries
while read -r library; do keep "$library"; done </tmp/libraries

# The licences of what is in the image go with it.
while read -r library; do
  dpkg -S "*/$(basename "$(readlink -f "$library")")" 2>/dev/null || true
done </tmp/libraries | sed 's/:.*//' | sort -u >/tmp/packages
while read -r name; do
  if [ -e "/usr/share/doc/$name/copyright" ]; then keep "/usr/share/doc/$name/copyright"; fi
done </tmp/packages

echo 'coop:x:10001:10001::/var/lib/coop:/usr/sbin/nologin' >"$root/etc/passwd"
echo 'coop:x:10001:' >"$root/etc/group"
echo 'hosts: files dns' >"$root/etc/nsswitch.conf"
chmod 1777 "$root/tmp"
# Folders that become the user's; a tmpfs laid over one takes its mode.
mkdir -p /own/run/coop /own/lib/coop
chmod 0700 /own/run/coop /own/lib/coop
du -sm "$root"
