#!/bin/sh
# Blender 4.2 or later without a window: the add-on is installed from ZIP and bakes the scene that coming.py left.
#
#   tests/package/command.sh BLENDER ZIP SCENE     with a home of its own; closes with `N passed, N failed`
blender=$1 zip=$2 scene=$3
folder=$(dirname "$scene") passed=0 failed=0

expect() { # wanted code, words that its output has, command ...
    wanted=$1 words=$2
    shift 2
    told=$("$@" 2>&1)
    code=$?
    case $code-$told in
        "$wanted"-*"$words"*) passed=$((passed + 1)) ;;
        *) failed=$((failed + 1)); echo "$*: code $code, not $wanted with '$words': $told" ;;
    esac
}

expect 0 "" "$blender" --command extension validate "$zip"
expect 0 "" "$blender" --command extension install-file -r user_default -e "$zip"
expect 0 "desire_path" "$blender" --command extension list
expect 0 "Baked frames" "$blender" --command desire_path bake "$scene" --ground Ground --report "$folder/told.json"
expect 0 '"problems": []' cat "$folder/told.json"
expect 1 "There is no ground 'Sea'" "$blender" --command desire_path bake "$scene" --ground Sea --report "$folder/sea.json"
expect 0 "There is no ground 'Sea'" cat "$folder/sea.json"
expect 1 "is not there" "$blender" --command desire_path bake "$folder/none.blend"
expect 2 "usage: blender --command desire_path" "$blender" --command desire_path
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
