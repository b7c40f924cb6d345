#!/bin/sh
# test_encodings.sh BUILD: other programs decode JPEG, WebP, PFM, TIFF and animations as the PNG or NPY of the same picture:
# Pillow, numpy, tifffile, dwebp, djpeg, webpinfo and pngcheck. Missing ones, but for the first two, are reported. Prints TAP.
set -u
build=$(realpath "$1")
zraster=$build/zraster
work=$(mktemp -d)
. tests/support/verdict.sh
said=$work/said complained=$work/complained
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
cat >scene.json <<'END'
{"window": {"width": 160, "height": 120}, "view": {"eye": [1, 2, 4]}, "polygons": [
 {"vertices": [[-1,-1,0],[1,-1,0.5],[0,1,0]], "color": "#336699"}, {"vertices": [[-1,1,0],[1,1,0.2],[0,-1,0.3]], "color": "#3380a0"}]}
END

for name in a.png a.jpg a.jpeg a.webp; do
    check "-o $name" 0 "$zraster" scene.json -o $name
done
verdict ".jpeg is .jpg" cmp -s a.jpg a.jpeg
check "lossless" 0 "$zraster" scene.json -o whole.webp --lossless
check "lossless, with more effort" 0 "$zraster" scene.json -o small.webp --lossless --compress small
check "a PNG by one thread" 0 "$zraster" scene.json -o whole.png --threads 1
sed 's/"window"/"background": [0.5, 0.5, 0.5, 0.25], "window"/' scene.json >clear.json
check "a clear PNG" 0 "$zraster" clear.json -o clear.png
check "a clear WebP" 0 "$zraster" clear.json -o clear.webp --lossless
check "but no clear JPEG" 2 "$zraster" clear.json -o clear.jpg
verdict "whose reason is told" grep -q 'a jpeg has no alpha' "$complained"
for channel in depth position texcoord; do
    check "$channel" 0 "$zraster" scene.json -c $channel -o $channel.npy
    check "$channel as TIFF" 0 "$zraster" scene.json -c $channel -o $channel.tif
done
for channel in depth position; do check "$channel as PFM" 0 "$zraster" scene.json -c $channel -o $channel.pfm; done
check "a PFM is of depth" 0 "$zraster" scene.json -o own.pfm
verdict "by itself" cmp -s own.pfm depth.pfm
check "distance as PNG" 0 "$zraster" scene.json -c distance --encoding png16 --scale 0.001 -o distance.png
check "distance" 0 "$zraster" scene.json -c distance -o distance.npy
check "at most 1500 bytes" 0 "$zraster" scene.json -o fits.jpg --max-bytes 1500
verdict "are kept" [ "$(wc -c <fits.jpg)" -le 1500 ]
sed 's/"window"/"outputs": [{"channel": "color", "encoding": "jpeg", "quality": 5}], "window"/' scene.json >own.json
check "a scene keeps its own outputs" 0 "$zraster" own.json -o own.jpg
verdict "with their quality" [ "$(wc -c <own.jpg)" -lt "$(wc -c <a.jpg)" ]
for threads in 1 3; do
    check "with $threads threads" 0 "$zraster" scene.json -o $threads.webp --threads $threads --max-bytes 1200
done
verdict "the same bytes" cmp -s 1.webp 3.webp


# Animations, beside the pictures of their views: ZIPs of 0001.color.png to 0005.color.png, color.apng and color.webp.
outputs='{"channel": "color", "encoding": "png32"}, {"channel": "color", "encoding": "apng"}, {"channel": "color", "encoding": "webp"'
for scene in scene clear; do
    sed "s/\"window\"/\"turntable\": {\"frames\": 5, \"elevation\": 20, \"seconds\": 0.5}, \"outputs\": [$outputs, \"lossless\": true}], \"window\"/
        s/\"view\": {[^}]*}/\"view\": {\"perspective\": {\"yfovDegrees\": 30}}/" $scene.json >turn-$scene.json
    sed 's/"lossless": true/"quality": 80/' turn-$scene.json >lossy-$scene.json
    check "animations, $scene" 0 "$zraster" turn-$scene.json -o turn-$scene.zip
    check "lossy, $scene" 0 "$zraster" lossy-$scene.json -o lossy-$scene.zip
done

/usr/bin/python3 - >"$said" 2>&1 <<'END'
import io, numpy, struct, zipfile
from PIL import Image

def pixels(name, mode): return numpy.asarray(Image.open(name).convert(mode)).astype(int)

def far(name): return abs(pixels(name, "RGB") - pixels("a.png", "RGB")).mean()

def pfm(name):
    kind, size, order, data = open(name, "rb").read().split(b"\n", 3)
    width, height = map(int, size.split())
    assert order == b"-1.0"
    return numpy.frombuffer(data, "<f4").reshape(height, width, *[3] * (kind == b"PF"))[::-1]

def tiff(name, like):
    data = open(name, "rb").read()
    return numpy.frombuffer(data[-like.nbytes:], "<f4").reshape(like.shape)

for name, most in ("a.jpg", 2), ("a.webp", 2), ("fits.jpg", 12):
    assert Image.open(name).size == (160, 120) and far(name) < most, (name, far(name))
for name in "whole.webp", "small.webp":
    assert far(name) == 0, name
assert (pixels("clear.webp", "RGBA") == pixels("clear.png", "RGBA")).all()
for name in "depth", "position", "texcoord":
    values = numpy.load(name + ".npy")
    assert numpy.array_equal(tiff(name + ".tif", values), values), name
    if name != "texcoord": assert numpy.array_equal(pfm(name + ".pfm"), values), name
depth = Image.open("depth.tif")
assert depth.mode == "F" and numpy.array_equal(numpy.asarray(depth), numpy.load("depth.npy"))
steps, distance = numpy.asarray(Image.open("distance.png")).astype(int), numpy.load("distance.npy")
seen = numpy.isfinite(distance)
assert seen.any() and (steps[~seen] == 0).all() and abs(steps[seen] * 0.001 - distance[seen]).max() < 0.00051

def frames(data, mode):
    picture = Image.open(io.BytesIO(data))
    assert picture.n_frames == 5 and picture.info["loop"] == 0
    for i in range(5):
        picture.seek(i)
        picture.load()
        assert picture.info["duration"] == 100, picture.info["duration"]
        yield numpy.asarray(picture.convert(mode)).astype(int)

for scene, mode in ("scene", "RGB"), ("clear", "RGBA"):
    for kind in "turn", "lossy":
        with zipfile.ZipFile(f"{kind}-{scene}.zip") as files:
            views = [numpy.asarray(Image.open(files.open(f"000{i}.color.png")).convert(mode)).astype(int) for i in range(1, 6)]
            apng, webp = files.read("color.apng"), files.read("color.webp")
        open(f"{kind}-{scene}.apng", "wb").write(apng), open(f"{kind}-{scene}.webp", "wb").write(webp)
        assert all((views[i] != views[i - 1]).any() for i in range(5))
        assert all(map(numpy.array_equal, frames(apng, mode), views)), scene
        apart = [abs(a - b).mean() for a, b in zip(frames(webp, mode), views)]
        assert max(apart) == 0 if kind == "turn" else 0 < max(apart) < 2, (kind, scene, apart)
END
verdict "Pillow and numpy agree" [ $? = 0 ]
for scene in scene clear; do check "pngcheck, $scene" 0 pngcheck -q turn-$scene.apng; done

if /usr/bin/python3 -c 'import tifffile' 2>/dev/null; then
    /usr/bin/python3 - >"$said" 2>&1 <<'END'
import numpy, tifffile
for name in "depth", "position", "texcoord":
    values = tifffile.imread(name + ".tif")
    assert values.dtype == "float32" and numpy.array_equal(values, numpy.load(name + ".npy")), (name, values.shape)
END
    verdict "tifffile has the floats" [ $? = 0 ]
else
    skip "tifffile has the floats" "it is not installed"
fi

if command -v dwebp >/dev/null; then
    check "dwebp" 0 dwebp -quiet whole.webp -ppm -o whole.ppm
    verdict "has the pixels" /usr/bin/python3 -c 'from PIL import Image
assert Image.open("whole.ppm").tobytes() == Image.open("a.png").convert("RGB").tobytes()'
else
    skip "dwebp" "it is not installed"
fi
if command -v webpinfo >/dev/null; then
    for name in a whole clear turn-scene turn-clear lossy-scene lossy-clear; do
        check "webpinfo, $name" 0 webpinfo $name.webp
        verdict "finds no fault" grep -q '^No error detected' "$said"
    done
else
    skip "webpinfo" "it is not installed"
fi
if command -v djpeg >/dev/null; then
    check "djpeg" 0 djpeg -outfile a.ppm a.jpg
    verdict "has Pillow's pixels" /usr/bin/python3 -c 'from PIL import Image
assert Image.open("a.ppm").tobytes() == Image.open("a.jpg").tobytes()'
else
    skip "djpeg" "it is not installed"
fi
verdicts
