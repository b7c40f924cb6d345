#!/bin/sh
# licences.sh SOURCES: prints the licences of all that is in zraster.wasm: ours, the codecs', the C library's and the compiler's.
set -eu
sources=$1
section() { # NAME FILE
    printf '%s\n%s\n\n' "$1" "$(printf '%s' "$1" | sed 's/./=/g')"
    cat "$2"
    printf '\n\n'
}
section zraster LICENSE
section "Versions of the codecs (Debian's sources)" "$sources/versions"
for name in isal jpeg png webp zlib; do section "$name" "$sources/$name/debian/copyright"; done
section "wasi-libc" /usr/share/doc/wasi-libc/copyright
section "compiler-rt" /usr/share/doc/libclang-rt-19-dev-wasm32/copyright
