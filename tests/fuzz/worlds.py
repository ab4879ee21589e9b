# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Takes the worlds of scenes/ and a small solid in every mesh format, damages one of their files and runs scipd --check.
# Within a minute or two scipd must say that all is well or what is wrong. Anything else is a find, and so is any report
# of a sanitizer about scipd itself. The end of a child that reads a mesh is no find, because that is what the child is
# for.
#
#   worlds.py SCIPD SCENES SEED COUNT|SECONDSs [FINDS]     FINDS: the folder for finds
import pathlib
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

LONGEST_S = 120
CORNERS = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
NUMBERS = [b"nan", b"inf", b"-inf", b"-1", b"0", b"-0.0", b"1e308", b"-1e308", b"1e39", b"1e-320", b"4294967295",
           b"2147483648", b"99999999999999999999", b"1e", b"0x7f", b"", b"1 2", b"1e7", b"3.5"]
WORDS = [struct.pack("<I", word) for word in (0, 1, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x7FC00000, 0x7F800000,
                                               0x10000000)]

EVERY_SHAPE = """<?xml version="1.0"?>
<sdf version="1.9" xmlns:scipd="urn:scipd:sdf"><world name="w">
<frame name="f" attached_to="m"><pose>1 2 3 0.1 0.2 0.3</pose></frame>
<model name="m"><static>1</static><pose relative_to="world">1 0 0 0 0 0.5</pose><link name="l">
<visual name="a"><pose degrees="true">0 0 1 0 0 90</pose><geometry><box><size>1 2 3</size></box></geometry>\
<scipd:material>wood</scipd:material></visual>
<visual name="b"><geometry><sphere><radius>0.5</radius></sphere></geometry><laser_retro>12</laser_retro></visual>
<visual name="c"><geometry><cylinder><radius>0.5</radius><length>2</length></cylinder></geometry></visual>
<visual name="d"><geometry><capsule><radius>0.5</radius><length>2</length></capsule></geometry></visual>
<visual name="e"><geometry><ellipsoid><radii>0.5 1 2</radii></ellipsoid></geometry></visual>
<visual name="g"><geometry><plane><normal>0 0 1</normal><size>10 10</size></plane></geometry></visual>
<visual name="h"><geometry><polyline><point>0 0</point><point>1 0</point><point>1 1</point><point>0 2</point>\
<height>1</height></polyline></geometry></visual>
<visual name="i"><geometry><mesh><uri>solid.obj</uri><scale>1 2 3</scale></mesh></geometry></visual>
</link></model>
<model name="n"><link name="k"/><link name="l"><pose relative_to="k">0 0 1 0 0 0</pose><collision name="c"><geometry>\
<box><size>1 1 1</size></box></geometry></collision></link>
<joint name="j" type="revolute"><parent>k</parent><child>l</child><axis><xyz>0 0 1</xyz></axis></joint>
<model name="o"><link name="p"/><frame name="q"/></model></model>
<include><uri>model://carton</uri><name>box</name><pose>3 3 0 0 0 0</pose></include>
</world></sdf>
"""
SAVED = """<?xml version="1.0"?>
<sdf version="1.7"><world name="w">
<model name="m"><link name="a::b"><pose frame="">0 0 1 0 0 0</pose><visual name="v"><geometry><box><size>1 1 1</size>\
</box></geometry></visual>
<sensor name="s" type="ray"><pose>0 0 1 0 0 0.5</pose><update_rate>10</update_rate><ray><scan><horizontal>\
<samples>360</samples>
<min_angle>-2</min_angle><max_angle>2</max_angle></horizontal></scan><range><min>0.1</min><max>30</max></range></ray>\
</sensor></link></model>
<model name="n"><static>1</static><link name="l"><visual name="v"><geometry><cone><radius>0.5</radius>\
<length>1</length></cone></geometry></visual>
<visual name="h"><geometry><heightmap><uri>hills.png</uri><size>10 10 2</size><pos>0 0 0</pos><sampling>2</sampling>\
</heightmap></geometry>
</visual></link></model>
<road name="r"><width>2</width><point>0 0 0</point><point>5 0 0.1</point><point>5 5 0</point></road>
<actor name="man"><pose>1 0 0 0 0 0</pose><skin><filename>solid.obj</filename><scale>1.1</scale></skin><script>\
<loop>true</loop>
<delay_start>1</delay_start><trajectory id="0" type="walk" tension="0.3"><waypoint><time>0</time>\
<pose>0 0 1 0 0 0</pose></waypoint>
<waypoint><time>2</time><pose>2 0 1 0 0 0</pose></waypoint><waypoint><time>4</time><pose>2 2 1 0 0 1.5</pose>\
</waypoint></trajectory></script></actor>
<state world_name="w"><sim_time>1 2</sim_time><model name="m"><pose>1 2 3 0 0 0.5</pose><scale>1 2 3</scale>\
<link name="a::b">
<pose>1 2 4 0 0 0.5</pose></link></model><insertions><model name="x"><link name="l"/></model></insertions><deletions>\
<name>n</name></deletions></state>
</world></sdf>
"""
ONE_MESH = """<sdf version="1.9"><model name="m"><link name="l">\
<visual name="v"><geometry><mesh><uri>{}</uri></mesh></geometry>
</visual></link></model></sdf>
"""


def xyz(corner):
    return " ".join(str(x) for x in corner)


def stl():
    facets = "".join("facet normal 0 0 1\nouter loop\n" + "".join(f"vertex {xyz(CORNERS[i])}\n" for i in face) +
                     "endloop\nendfacet\n" for face in FACES)
    binary = b"solid of four".ljust(80, b"\0") + struct.pack("<I", len(FACES))
    for face in FACES:
        binary += struct.pack("<12f", 0, 0, 1, *(x for i in face for x in CORNERS[i])) + b"\0\0"
    return f"solid s\n{facets}endsolid s\n".encode(), binary


def ply():
    def head(kind):
        return (f"ply\nformat {kind} 1.0\nelement vertex {len(CORNERS)}\nproperty float x\nproperty float y\n"
                "property float z\n"
                f"element face {len(FACES)}\nproperty list uchar int vertex_indices\nend_header\n").encode()

    text = "".join(xyz(corner) + "\n" for corner in CORNERS) + "".join("3 %d %d %d\n" % face for face in FACES)
    binary = b"".join(struct.pack("<3f", *corner) for corner in CORNERS)
    binary += b"".join(struct.pack("<B3i", 3, *face) for face in FACES)
    return head("ascii") + text.encode(), head("binary_little_endian") + binary


def glb():
    data = b"".join(struct.pack("<3f", *corner) for corner in CORNERS)
    data += b"".join(struct.pack("<3H", *face) for face in FACES)
    json = ('{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],'
            '"nodes":[{"mesh":0,"scale":[1,1,1]}],"meshes":[{'
            '"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],"materials":[{"name":"oak"}],'
            f'"buffers":[{{"byteLength":{len(data)}}}],"bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":48}},'
            '{"buffer":0,"byteOffset":48,"byteLength":24}],'
            '"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3",'
            '"count":4,"min":[0,0,0],"max":[1,1,1]},{"bufferView":1,"componentType":5123,"type":"SCALAR",'
            '"count":12}]}').encode()
    json = json.ljust(-(-len(json) // 4) * 4)
    chunks = struct.pack("<I4s", len(json), b"JSON") + json + struct.pack("<I4s", len(data), b"BIN\0") + data
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


def dae():
    p = " ".join(str(i) for face in FACES for i in face)
    return f"""<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1" name="meter"/><up_axis>Z_UP</up_axis></asset><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="12">{" ".join(map(xyz, CORNERS))}</float_array><technique_common>
<accessor source="#a" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>\
<param name="Z" type="float"/>
</accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>{p}</p></triangles></mesh></geometry>
</library_geometries><library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node>\
</visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>""".encode()


def png():
    """Heights of 9 x 9 points, grey, 8 bits."""
    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    rows = b"".join(b"\0" + bytes(x * y * 3 for x in range(9)) for y in range(9))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", 9, 9, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) +
            chunk(b"IEND", b""))


def sources(scenes):
    """Files to damage: (name, bytes, the scene that shows it, or None if it is the scene)."""
    obj = "mtllib solid.mtl\nusemtl oak\n" + "".join(f"v {xyz(c)}\n" for c in CORNERS)
    obj += "".join("f %d %d %d\n" % tuple(i + 1 for i in face) for face in FACES)
    (scenes / "solid.obj").write_text(obj)
    (scenes / "solid.mtl").write_text("newmtl oak\nKd 0.5 0.4 0.3\n")
    (scenes / "hills.png").write_bytes(png())
    stl_text, stl_binary = stl()
    ply_text, ply_binary = ply()
    meshes = [("obj", obj.encode()), ("stl", stl_text), ("stl", stl_binary), ("ply", ply_text),
              ("ply", ply_binary), ("glb", glb()),
              ("dae", dae())]
    for kind, content in meshes:
        yield f"case.{kind}", content, ("shown.sdf", ONE_MESH.format(f"case.{kind}"))
    yield "solid.mtl", (scenes / "solid.mtl").read_bytes(), ("shown.sdf", ONE_MESH.format("solid.obj"))
    for _ in range(5):
        yield "case.sdf", EVERY_SHAPE.encode(), None
        yield "case.sdf", SAVED.encode(), None
    yield "hills.png", png(), ("shown.sdf", SAVED)
    for name in ("square_room.sdf", "crossing.sdf", "corridor.sdf", "depot.sdf", "rescue_maze.sdf",
                 "models/carton/model.sdf"):
        yield "case.sdf", (scenes / name).read_bytes(), None
    yield "case.urdf", (scenes / "models/forklift.urdf").read_bytes(), None
    yield "case.yaml", (scenes / "office_map.yaml").read_bytes(), None
    yield "office_map.pgm", (scenes / "office_map.pgm").read_bytes(), ("office_map.yaml", None)


def flip(chance, content):
    damaged = bytearray(content)
    for _ in range(chance.choice((1, 1, 2, 8, 40))):
        damaged[chance.randrange(len(damaged))] ^= 1 << chance.randrange(8)
    return bytes(damaged)


def cut(chance, content):
    begin = chance.randrange(len(content))
    return content[:begin] + (content[chance.randrange(begin, len(content)):] if chance.random() < 0.5 else b"")


def renumber(chance, content):
    found = list(re.finditer(rb"-?\d+(\.\d+)?(e-?\d+)?", content))
    for number in sorted(chance.sample(found, min(len(found), chance.choice((1, 1, 3)))), key=lambda m: -m.start()):
        content = content[:number.start()] + chance.choice(NUMBERS) + content[number.end():]
    return content


def overwrite(chance, content):
    at = chance.randrange(max(1, len(content) - 4))
    return content[:at] + chance.choice(WORDS) + content[at + 4:]


def repeat(chance, content):
    begin = chance.randrange(len(content))
    end = min(len(content), begin + chance.choice((1, 10, 100, 1000)))
    return content[:end] + content[begin:end] * chance.choice((1, 2, 50, 2000)) + content[end:]


def repeat_element(chance, content):
    found = list(re.finditer(rb"<(\w+)[ >]", content))
    if not found:
        return repeat(chance, content)
    first = chance.choice(found)
    end = content.find(b"</" + first[1] + b">", first.end())
    if end < 0:
        return repeat(chance, content)
    end += len(first[1]) + 3
    element = content[first.start():end]
    times = chance.choice((1, 3, 300))
    if chance.random() < 0.5:
        return content[:end] + element * times + content[end:]
    inner = first[0] if first[0].endswith(b">") else b"<" + first[1] + b">"
    return content[:first.start()] + inner * times + element + (b"</" + first[1] + b">") * times + content[end:]


def swap_word(chance, content):
    words = list(re.finditer(rb"[A-Za-z_]{2,}", content))
    if len(words) < 2:
        return flip(chance, content)
    one, other = chance.sample(words, 2)
    return content[:one.start()] + other[0] + content[one.end():]


def damaged(chance, content):
    for _ in range(chance.choice((1, 1, 1, 2, 4))):
        content = chance.choice((flip, cut, renumber, renumber, overwrite, repeat, repeat_element, repeat_element,
                                 swap_word))(
            chance, content or b"0")
    return content[:1 << 22]


def check(scipd, scenes, chance):
    """The kind of file, what was wrong with the answer (None if nothing was), and the whole output."""
    name, content, shown = chance.choice(list(sources(scenes)))
    (scenes / name).write_bytes(damaged(chance, content))
    scene = name
    if shown:
        scene, text = shown
        if text:
            (scenes / scene).write_text(text)
    (scenes / "rig.yaml").write_text(
        f"scene: {scene}\nrobots: {{r: {{sensors: {{s: {{model: UST-10LX, pty: auto}}}}}}}}\n")
    try:
        run = subprocess.run([scipd, "--check", scenes / "rig.yaml"], capture_output=True, timeout=LONGEST_S,
                             check=False)
    except subprocess.TimeoutExpired:
        return name, f"takes more than {LONGEST_S} s", b""
    said = run.stdout + run.stderr
    if run.returncode not in (0, 2):
        return name, f"ends with {run.returncode}", said
    if b"runtime error:" in said:
        return name, "does what is undefined", said
    if run.returncode == 2 and not run.stderr.strip():
        return name, "refuses without a word", said
    return name, None, said


def main():
    scipd, origin, seed, amount = sys.argv[1:5]
    finds = pathlib.Path(sys.argv[5]) if len(sys.argv) > 5 else None
    count = None if amount.endswith("s") else int(amount)
    end = time.monotonic() + float(amount[:-1]) if count is None else None
    tally = {"well": 0, "refused": 0, "child": 0, "finds": 0}
    slowest = 0.0
    number = 0
    while number < count if count is not None else time.monotonic() < end:
        case = f"{seed}.{number}"
        with tempfile.TemporaryDirectory() as folder:
            scenes = pathlib.Path(folder) / "scenes"
            shutil.copytree(origin, scenes)
            begin = time.monotonic()
            name, fault, said = check(scipd, scenes, random.Random(case))
            slowest = max(slowest, time.monotonic() - begin)
            if fault:
                print(f"case {case}, {name}: scipd {fault}\n{said.decode(errors='replace')[-4000:]}", flush=True)
                if finds:
                    shutil.copytree(scenes, finds / f"worlds-{case}")
        tally["finds" if fault else "well" if b"no errors" in said else "refused"] += 1
        tally["child"] += b"Sanitizer" in said or b"crashes the library" in said
        number += 1
    print(f"{number} worlds: {tally['well']} well, {tally['refused']} refused "
          f"({tally['child']} of them by the end of a child), "
          f"{tally['finds']} finds; the slowest took {slowest:.1f} s")
    return 1 if tally["finds"] else 0


sys.exit(main())
