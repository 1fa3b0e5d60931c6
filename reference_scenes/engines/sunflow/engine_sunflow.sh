#!/bin/sh
# engine_sunflow: starts engine_sunflow.java, which lies beside it. Exit code 69: something is not installed.
jars=${LOBELIA_JARS:-/usr/share/java}
if ! command -v java > /dev/null; then
  echo "no program 'java' in \$PATH" >&2
  exit 69
fi
path=
for jar in sunflow janino commons-compiler commons-compiler-jdk; do
  if [ ! -e "$jars/$jar.jar" ]; then
    echo "no file '$jars/$jar.jar'" >&2
    exit 69
  fi
  path=$path:$jars/$jar.jar
done
# Without what it would write elsewhere, and with the compiler that starts fastest.
exec java -XX:-UsePerfData -XX:+UseSerialGC -XX:TieredStopAtLevel=1 -Djava.awt.headless=true \
  -cp "${path#:}" "$(dirname "$0")/engine_sunflow.java" "$@"
