"""Renders known scenes with a worker (PROTOCOL.md) and reports what is wrong with its pictures.

    python3 check.py [--json] [--resolution N] [--timeout SECONDS] WORKER_COMMAND...

WORKER_COMMAND is the command of a worker, or the name of a worker in workers.json. The exit code is 1 if a check
fails.
"""
import argparse
import array
import json
import math
import os
import pathlib
import select
import signal
import struct
import subprocess
import sys
import tempfile

FOLDER = pathlib.Path(__file__).resolve().parent
CAMERA = 3.0  # distance of the camera, at which the sphere touches the edges of the picture
HEADLIGHT, ASIDE, FAR = (0, 3), (60, 3), (0, 6)  # lights, as angle and distance
SAME = 2e-3  # larger differences are errors; half floats differ by up to 5e-4
WIDE = 0.5  # an alpha whose highlight has no sharp peak
# Renderers differ by these factors in what their unit of light means.
FACTORS = {"pi": math.pi, "1 / pi": 1 / math.pi, "4 pi": 4 * math.pi, "1 / (4 pi)": 0.25 / math.pi, "4": 4, "1 / 4": 0.25}
OWN_WIDTH = {"alpha": lambda a: a, "roughness": math.sqrt, "exponent": lambda a: 2 / a**2 - 2,
             "glossiness": lambda a: 1 - math.sqrt(a), "squared": lambda a: a**2}
ENVIRONMENT = (128, 64)  # columns and rows
ALPHA = {"alpha": lambda w: w, "roughness": lambda w: w**2, "exponent": lambda w: math.sqrt(2 / (w + 2)),
         "glossiness": lambda w: (1 - w)**2, "squared": math.sqrt}


class Refused(Exception):
    """The worker answered with an error."""


class Broken(Exception):
    """The worker broke the protocol or has ended, so that no further request is possible."""


class Worker:
    def __init__(self, command, folder, timeout):
        self.image, self.timeout, self.number, self.pending = folder / "picture.f32", timeout, 0, b""
        self.log = open(folder / "log", "wb+")
        self.process = subprocess.Popen(["sh", "-c", "exec " + command], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=self.log, start_new_session=True)

    def close(self):
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.process.wait()

    def broken(self, words):
        self.log.seek(0)
        last = self.log.read().decode(errors="replace").splitlines()[-5:]
        return Broken(words + ("; last lines of its log: " + " / ".join(last) if last else ""))

    def line(self):
        while b"\n" not in self.pending:
            if not select.select([self.process.stdout], [], [], self.timeout)[0]:
                raise self.broken(f"no answer within {self.timeout:g} s")
            more = os.read(self.process.stdout.fileno(), 1 << 16)
            if not more:
                code = self.process.wait()
                raise self.broken(f"died with signal {-code}" if code < 0 else f"ended with exit code {code}")
            self.pending += more
        line, self.pending = self.pending.split(b"\n", 1)
        return line.decode(errors="replace")

    def ask(self, **request):
        self.number += 1
        try:
            self.process.stdin.write(json.dumps({"id": self.number, **request}).encode() + b"\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            pass  # line() then reports that the worker has ended
        line = self.line()
        while self.number == 1 and not line.startswith("{"):  # skips a banner
            line = self.line()
        try:
            answer = json.loads(line)
        except ValueError:
            answer = None
        if not isinstance(answer, dict) or answer.get("id") != self.number:
            raise self.broken(f"this is not the answer to request {self.number}: {line[:80]!r}")
        if "error" in answer:
            raise Refused(str(answer["error"])[:2000])
        return answer

    def floats(self, name, width, height, values):
        """Writes a map or an environment. Returns its place in a request."""
        path = self.image.with_name(name + ".f32")
        path.write_bytes(array.array("f", values).tobytes())
        return {"map": str(path), "width": width, "height": height}

    def render(self, model, parameters, light, resolution, samples, seed):
        """Returns a picture. `light` is an angle and a distance, or the values of an environment."""
        if len(light) > 2:
            place = self.floats("environment", *ENVIRONMENT, light)
            source = {"environment": place.pop("map"), **place, "samples": 64}
        else:
            turn, distance = math.radians(light[0]), light[1]
            source = {"angle": light[0], "distance": distance, "intensity": 1,
                      "position": [distance * math.sin(turn), 0, distance * math.cos(turn)]}
        has_maps = len(light) > 2 or any(isinstance(values, dict) for values in parameters.values())
        channels = 3 if has_maps or any(len(values) > 1 for values in parameters.values()) else 1
        scene = {"resolution": resolution, "samples_per_axis": samples,
                 "camera": {"distance": CAMERA, "half_angle": math.degrees(math.asin(1 / CAMERA))},
                 "light": source}
        self.image.unlink(missing_ok=True)
        self.ask(request="render", model=model, parameters=parameters, scene=scene, seed=seed, channels=channels,
                 image=str(self.image))
        values = array.array("f")
        try:
            values.frombytes(self.image.read_bytes())
        except (OSError, ValueError) as failure:
            raise Refused(f"the picture cannot be read: {failure}")
        if len(values) != resolution**2 * channels:
            raise Refused(f"the picture has {len(values)} values, not {resolution**2 * channels}")
        if any(not math.isfinite(v) or v > 1e18 for v in values) or min(values) < -1e-4 * max(values):
            raise Refused("values of a picture must be finite, not above 1e18 and not negative")
        return Picture(resolution, [values[c::channels] for c in range(channels)])


def normal(side, row, column):
    """Returns the point of the sphere at a pixel's centre, or None beside the sphere."""
    half = 1 / math.sqrt(CAMERA**2 - 1)  # half the width of the picture at distance 1
    dx, dy = ((2 * (column + 0.5) / side - 1) * half, (1 - 2 * (row + 0.5) / side) * half)
    a = dx * dx + dy * dy + 1
    root = CAMERA**2 - a * (CAMERA**2 - 1)
    if root <= 0:
        return None
    t = (CAMERA - math.sqrt(root)) / a
    return t * dx, t * dy, CAMERA - t


class Picture:
    def __init__(self, side, channels):
        self.side, self.channels, self.values = side, channels, channels[0]

    def made(self, side, pixel):
        return Picture(side, [array.array("f", (pixel(i // side, i % side) for i in range(side * side)))])

    def at(self, row, column):
        return self.values[row * self.side + column]

    def flipped(self, rows):
        last = self.side - 1
        return self.made(self.side, lambda r, c: self.at(last - r, c) if rows else self.at(r, last - c))

    def every_third(self):
        """Returns the pixel centres of a picture with a third of the side."""
        return self.made(self.side // 3, lambda r, c: self.at(3 * r + 1, 3 * c + 1))

    def mean_of_nine(self):
        return self.made(self.side // 3, lambda r, c: sum(self.at(3 * r + i // 3, 3 * c + i % 3) for i in range(9)) / 9)

    def minus(self, other):
        return Picture(self.side, [array.array("f", (a - b for a, b in zip(self.values, other.values)))])

    def times(self, factor):
        return Picture(self.side, [array.array("f", (factor * value for value in self.values))])

    def brightest(self):
        return max(map(abs, self.values))

    def brightest_outside(self):
        return max(abs(v) for i, v in enumerate(self.values) if normal(self.side, i // self.side, i % self.side) is None)

    def centre(self):
        """Returns the mean position of the light, from -1 (left, bottom) to 1."""
        light = sum(self.values)
        if not light > 0:
            return 0, 0
        places = [2 * (i + 0.5) / self.side - 1 for i in range(self.side)]
        return (sum(v * places[i % self.side] for i, v in enumerate(self.values)) / light,
                -sum(v * places[i // self.side] for i, v in enumerate(self.values)) / light)

    def within(self):
        """Yields the pixels whose neighbours show the sphere, too: there, the cosine to the camera is above 0.2."""
        for i in range(self.side**2):
            n = normal(self.side, i // self.side, i % self.side)
            if n and (CAMERA * n[2] - 1) / math.dist(n, (0, 0, CAMERA)) > 0.2:
                yield i

    def difference(self, other):
        """Returns the RMS difference from `other`, relative to the RMS of this picture."""
        square = power = 0.0
        for i in self.within():
            square += (self.values[i] - other.values[i])**2
            power += self.values[i]**2
        return math.sqrt(square / max(power, 1e-30)) if square else 0.0

    def over(self, unit):
        """Returns the least squares factor by which this picture is brighter than `unit`."""
        pairs = [(self.values[i], unit.values[i]) for i in self.within()]
        power = sum(y * y for _, y in pairs)
        return sum(x * y for x, y in pairs) / power if power > 0 else 0.0


def lambertian(side, light):
    """Returns the picture of a Lambertian sphere of albedo 1 under a light of radiant intensity 1."""
    x, z = light[1] * math.sin(math.radians(light[0])), light[1] * math.cos(math.radians(light[0]))

    def pixel(row, column):
        n = normal(side, row, column)
        if n is None:
            return 0.0
        away = math.dist(n, (x, 0, z))
        return max(0.0, (x * n[0] + z * n[2] - 1) / away) / (math.pi * away**2)

    return Picture(side, [()]).made(side, pixel)


def environment(radiance):
    """Returns the values of an environment with the RGB radiance(x, y, z)."""
    values, (columns, rows) = array.array("f"), ENVIRONMENT
    for i in range(rows * columns):
        azimuth, polar = 2 * math.pi * ((i % columns + 0.5) / columns - 0.5), math.pi * (i // columns + 0.5) / rows
        values.extend(radiance(math.sin(polar) * math.sin(azimuth), math.cos(polar), -math.sin(polar) * math.cos(azimuth)))
    return values


def percent(share):
    return f"{100 * share:.2g} %"


class ModelCheck:
    def __init__(self, worker, model, side):
        self.worker, self.model, self.side, self.findings = worker, model, side, []
        self.noise = model.get("noise", False)
        self.role = {parameter["role"]: parameter for parameter in model["parameters"]}
        self.low, self.high = self.role["specular"]["range"]
        self.material(WIDE, self.low, 0)  # this needs every field of the description

    def run(self):
        try:
            for check in (self.refusals, self.geometry, self.light, self.values, self.repeats, self.samples, self.color,
                          self.width, self.textures):
                check()
        except (Refused, Broken) as failure:
            self.add("answer", "wrong", str(failure))
            return not isinstance(failure, Broken)
        return True

    def add(self, check, verdict, words):
        self.findings.append({"model": self.model["name"], "check": check, "verdict": verdict, "words": words})

    def judge(self, check, good, found, fault):
        self.add(check, "good" if good else "wrong", found if good else fault)

    def material(self, alpha, specular, diffuse):
        convention, (least, most) = self.role["roughness"]["convention"], self.role["roughness"]["range"]
        ends = sorted((ALPHA[convention](least), ALPHA[convention](most)))
        values = {p["name"]: [p["default"]] for p in self.model["parameters"] if p["role"] == "other"}
        values[self.role["roughness"]["name"]] = [OWN_WIDTH[convention](min(max(alpha, ends[0]), ends[1]))]
        values[self.role["specular"]["name"]] = specular if isinstance(specular, list) else [specular]
        if "diffuse" in self.role:
            values[self.role["diffuse"]["name"]] = [diffuse]
        return values

    def take(self, material, light=HEADLIGHT, seed=0, enlarged=1, samples=1, model=None):
        return self.worker.render(model or self.model["name"], material, light, enlarged * self.side, samples, seed)

    def highlight(self, alpha, light=HEADLIGHT, **more):
        return self.take(self.material(alpha, self.high, 0), light, **more)

    def diffuse(self, share, light):
        """Returns the light that diffuse adds to a picture."""
        full = self.role["diffuse"]["range"][1]
        lit, dark = (self.take(self.material(WIDE, self.low, value), light) for value in (share * full, 0))
        return lit.minus(dark)

    def refusals(self):
        name, beyond = self.role["specular"]["name"], self.high + 1
        self.refuses("range", self.material(WIDE, beyond, 0), None,
                     f"{name} = {beyond:g} was rendered, but is out of range (answer with an error)")
        unknown = self.model["name"] + "-which-is-none"
        self.refuses("unknown model", self.material(WIDE, self.high, 0), unknown,
                     unknown + " was rendered, but is unknown (answer with an error)")

    def refuses(self, check, material, model, otherwise):
        try:
            self.take(material, model=model)
        except Refused:
            self.add(check, "good", "refused")
        else:
            self.add(check, "wrong", otherwise)

    def geometry(self):
        """Checks where the light is: background, symmetry, left and right."""
        front = self.highlight(WIDE)
        top = front.brightest()
        if not top > 0:
            self.add("highlight", "wrong", "the picture at full specular is black under a headlight")
            return
        outside = front.brightest_outside()
        self.judge("background", outside <= 1e-6 * top, "black",
                   f"pixels outside the sphere are up to {outside:.6g}, not 0: wrong field of view, or an environment")
        rows, columns = front.difference(front.flipped(True)), front.difference(front.flipped(False))
        uneven = 0.0 if self.noise else max(rows, columns)
        halves = "upper and lower" if rows >= columns else "left and right"
        self.judge("symmetry", uneven <= SAME, "to " + percent(uneven),
                   f"under a headlight the {halves} halves differ by {percent(uneven)}: the picture is shifted, often by one "
                   "pixel, or the sphere is a mesh")
        x, y = self.highlight(WIDE, ASIDE).centre()
        if abs(y) > abs(x):
            where, why = "the top" if y > 0 else "the bottom", "rows and columns are exchanged"
        elif x < -0.1:
            where, why = "the left", "columns run from +x to -x, or the light turns the other way"
        else:
            where, why = "the middle", "the light does not move"
        self.judge("orientation", x > 0.1 and abs(y) < 0.05, "a light at +60 degrees is on the right",
                   f"a light at +60 degrees lights {where} of the picture, not the right: {why}")

    def light(self):
        """Checks diffuse light against Lambert's law: intensity, inverse square, linearity."""
        if "diffuse" not in self.role:
            self.add("light scale", "remark", "unknown: the model has no diffuse parameter")
            return
        full = self.role["diffuse"]["range"][1]
        near, unit = self.diffuse(1, HEADLIGHT), lambertian(self.side, HEADLIGHT)
        scale = near.over(unit) / full
        if not scale > 0:
            self.add("light scale", "wrong", "diffuse adds no light")
            return
        left = near.difference(unit.times(scale * full))
        known = "".join(f" ({name})" for name, value in FACTORS.items() if abs(scale / value - 1) < 0.01)
        if left > 0.02:
            self.add("light scale", "remark", f"the diffuse lobe is not Lambertian ({percent(left)} left); the best Lambertian "
                     f"lobe is {scale:.4g} times as bright as it should be")
        else:
            self.judge("light scale", abs(scale - 1) <= 2e-3, "within " + percent(abs(scale - 1)),
                       f"diffuse light is {scale:.4g} times as strong as it should be{known}; the light must have a radiant "
                       "intensity of 1")
        found, expected = self.diffuse(1, FAR).over(near), lambertian(self.side, FAR).over(unit)
        self.judge("inverse square", abs(found / expected - 1) < 0.01, "holds",
                   f"a light twice as far is {found:.3g} times as bright, not {expected:.3g}")
        half = self.diffuse(0.5, HEADLIGHT).over(near)
        exponent = math.log(half) / math.log(0.5) if half > 0 else math.inf
        self.judge("linearity", abs(half - 0.5) < 1e-3, "half the diffuse is half the light",
                   f"half the diffuse gives {half:.3g} of the light, not 0.5: a tone curve or display gamma of about "
                   f"{max(exponent, 1 / exponent):.2g}")

    def values(self):
        """Finds traces of storage or tone mapping in the values."""
        sharp = self.highlight(0.1)
        top = max(sharp.values)
        flat = sum(v == top for v in sharp.values)
        self.judge("clamping", sharp.brightest() != 1 or flat <= 4, f"none seen up to {sharp.brightest():.3g}",
                   f"{flat} pixels of a highlight are exactly 1: values are clamped")
        told = [v for channel in sharp.channels for v in channel if v not in (0, 1)]
        if all(abs(255 * v - round(255 * v)) < 1e-4 for v in told):
            self.add("precision", "wrong", "values have 8 bits (write floats)")
        elif all(struct.unpack("<I", struct.pack("<f", v))[0] & 0x1fff == 0 for v in told):  # only 10 of 23 bits are used
            self.add("precision", "remark", "values are half floats: steps of 0.05 %")
        else:
            self.add("precision", "good", "floats")

    def repeats(self):
        """Checks that a picture is the same after another one, and with another seed."""
        first = self.highlight(0.3, ASIDE)
        self.highlight(WIDE)
        again = first.difference(self.highlight(0.3, ASIDE))
        self.judge("repeatability", not again > 0, "bit for bit",
                   f"the same request gives pictures that differ by {percent(again)}: noise must depend on the seed only, and "
                   "requests must not affect later ones")
        noise = first.difference(self.highlight(0.3, ASIDE, seed=1))
        if noise > 0 and not self.noise:
            self.add("noise", "wrong", f"another seed gives a picture that differs by {percent(noise)} (describe the model with "
                     "\"noise\": true, or remove the noise)")
        elif noise > 0:
            self.add("noise", "remark", percent(noise) + " between two seeds")
        else:
            self.add("noise", "good", "none")

    def samples(self):
        """Checks that a picture has its pixel centres in common with a picture three times as large."""
        if self.noise:
            self.add("pixel centres", "remark", "not checked: the model has noise")
            return
        small, large = self.highlight(0.2, ASIDE), self.highlight(0.2, ASIDE, enlarged=3)
        jitter = small.difference(large.every_third())
        self.judge("pixel centres", jitter <= SAME, "to " + percent(jitter),
                   f"pixels differ by {percent(jitter)} from those of a larger picture with the same centres: jitter in the "
                   "pixel, a filter, or a shifted picture")
        grid = self.highlight(0.2, ASIDE, samples=3).difference(large.mean_of_nine())
        self.judge("pixel grid", grid <= SAME, "to " + percent(grid),
                   f"3 x 3 samples in a pixel differ by {percent(grid)} from the mean of nine pixels (sample an even grid)")

    def color(self):
        """Checks that channels are independent and in order."""
        values = [self.low + share * (self.high - self.low) for share in (1, 0.5, 0.25)]
        try:
            picture = self.take(self.material(WIDE, values, 0))
        except Refused as refused:
            self.add("color", "remark", f"none in {self.role['specular']['name']}: {refused}")
            return
        wrong = ""
        for c, value in enumerate(values):
            off = self.take(self.material(WIDE, value, 0)).difference(Picture(self.side, [picture.channels[c]]))
            if off > SAME and not wrong:
                wrong = (f"channel {c} differs by {percent(off)} from a grey picture of its value; channels must be red, green, "
                         "blue and independent")
        self.judge("color", not wrong, "red, green, blue", wrong)

    def textures(self):
        """Checks maps and environments."""
        if not self.model.get("textures", False):
            return
        numbers = self.material(WIDE, self.high, 0)
        maps = {p["name"]: self.worker.floats(p["role"], 4, 4, 16 * numbers[p["name"]]) | {"channels": 1}
                for p in self.model["parameters"] if p["role"] != "other"}
        off = self.take(numbers, ASIDE).difference(self.take({**numbers, **maps}, ASIDE))
        self.judge("constant maps", off <= SAME, "as numbers, to " + percent(off),
                   f"maps of one value differ by {percent(off)} from the numbers: color spaces, 8 bits, or another range")
        self.map_places(numbers)
        self.environments()

    def map_places(self, numbers):
        name, high, low = self.role["specular"]["name"], self.high, self.low
        for where, texels, axis in (("left", 4 * [high, high, low, low], 0), ("top", 8 * [high] + 8 * [low], 1)):
            numbers[name] = self.worker.floats("half", 4, 4, texels) | {"channels": 1}
            # the lobe at the edges of the picture is dim, so that only the sign of the place is certain
            place = (-1, 1)[axis] * self.take(numbers).centre()[axis]
            self.judge("map " + where, place > 0.05, f"at the {where} of the sphere",
                       f"the {where} of a map is not at the {where} of the sphere")

    def environments(self):
        """Checks the radiance of the brightest material, and from where light comes."""
        has_diffuse = "diffuse" in self.role
        white = self.material(WIDE, self.low if has_diffuse else self.high, self.role["diffuse"]["range"][1] if has_diffuse else 0)
        even = self.take(white, environment(lambda *_: (1, 1, 1)))
        mean = sum(even.values[i] for i in even.within()) / sum(1 for _ in even.within())
        least = 0.97 if has_diffuse else 0.5
        self.judge("environment", least <= mean <= 1.03, f"white is {mean:.3g} in an environment of 1",
                   f"white has a radiance of {mean:.3g} in an environment of 1; it must have {least:.3g} to 1")
        sides = self.take(white, environment(lambda x, y, z: (max(x, 0), max(y, 0), max(z, 0))))
        red, green, blue = (Picture(self.side, [channel]) for channel in sides.channels)
        bright = [sum(picture.values) for picture in (red, green, blue)]
        self.judge("light right", red.centre()[0] > 0.1, "is on the right", "the +x of an environment does not light the right")
        self.judge("light top", green.centre()[1] > 0.1, "is at the top", "the +y of an environment does not light the top")
        self.judge("light front", bright[2] > 1.5 * max(bright[:2]), "is in the middle",
                   "the +z of an environment, behind the camera, does not light the middle")

    def width(self):
        """Checks that a wider highlight has more light relative to its peak."""
        spreads = [sum(picture.values) / max(picture.brightest(), 1e-30) for picture in map(self.highlight, (0.15, 0.3, 0.6))]
        self.judge("width", spreads[0] < spreads[1] < spreads[2], "a larger alpha is a wider highlight",
                   "highlights do not widen from alpha 0.15 to 0.3 and 0.6 (check the convention)")


def command_of(words):
    """Returns the command of the worker of that name in workers.json, or the words themselves if no worker has the
    name."""
    config = pathlib.Path(os.environ.get("XDG_CONFIG_HOME") or "~/.config").expanduser() / "remap/workers.json"
    data = pathlib.Path(os.environ.get("XDG_DATA_HOME") or "~/.local/share").expanduser()
    os.environ.setdefault("REMAP_RENDERERS", str(data / "remap/renderers"))
    for path in (pathlib.Path(os.environ.get("REMAP_WORKERS") or config), FOLDER / "workers.json"):
        for worker in json.loads(path.read_text())["workers"] if path.is_file() else []:
            if worker["name"] == words:
                os.environ["REMAP_WORKER_FOLDER"] = str(path.parent)
                return worker["command"]
    return words


def checked(worker, side):
    """Returns the name of the renderer, and the results of the checks."""
    described, findings = worker.ask(request="describe", protocol=1, threads=os.cpu_count()), []
    for model in described["models"]:
        check = ModelCheck(worker, model, side)
        is_usable = check.run()
        findings += check.findings
        if not is_usable:
            break
    return described["renderer"], findings


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", action="store_true", help="print the findings as JSON")
    parser.add_argument("--resolution", type=int, default=48, help="width and height of the pictures in pixels (default: 48)")
    parser.add_argument("--timeout", type=float, default=120, help="seconds to wait for an answer (default: 120)")
    parser.add_argument("command", nargs=argparse.REMAINDER, metavar="WORKER_COMMAND")
    options = parser.parse_args()
    if not options.command:
        parser.error("name the command of a worker")
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # otherwise the worker would keep running
    with tempfile.TemporaryDirectory(prefix="remap-check-") as folder:
        worker = Worker(command_of(" ".join(options.command)), pathlib.Path(folder), options.timeout)
        try:
            renderer, findings = checked(worker, options.resolution)
        except (Refused, Broken) as failure:
            sys.exit(f"check.py: request describe: {failure}")
        except KeyError as missing:
            sys.exit(f"check.py: request describe: the answer has no {missing}")
        finally:
            worker.close()
    wrong = sum(finding["verdict"] == "wrong" for finding in findings)
    if options.json:
        print(json.dumps({"renderer": renderer, "wrong": wrong, "findings": findings}, indent=2))
    else:
        print(renderer)
        for i, finding in enumerate(findings):
            if i == 0 or finding["model"] != findings[i - 1]["model"]:
                print(finding["model"])
            print(f"  {finding['verdict']:8}{finding['check']:16}{finding['words']}")
    if wrong:
        sys.exit(f"check.py: {wrong} of {len(findings)} checks failed")


main()
