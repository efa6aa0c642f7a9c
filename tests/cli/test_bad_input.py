"""Wrong input: exit status 2, a message that helps, nothing computed, nothing written."""

import pytest

MODEL = """[material.sheet]
youngs_modulus = "3 GPa"
poissons_ratio = 0.45
density = 1145
[wing]
chord = "5 cm"
thickness = "1.6 mm"
material = "sheet"
[[wing.segment]]
span = "14 cm"
[[wing.segment]]
span = "10 cm"
hinge = { springs = 3, spacing = "15 mm", stiffness = "0.18 N*m/rad", fold = 30 }
"""

THREE = "three-segment"
LATTICE = ("convergence", THREE, "--aero", "lattice")
GRID = ("--fold2", "0:1000:1", "--fold3", "0:1000:1")

# arguments, and what the message must say: field, value, limit, remedy
CASES = [
    # models
    (("modes", "nosuch"), "MODEL", "'nosuch'", "TOML file", "three-segment"),
    (("modes", "thre-segment"), "MODEL", "'thre-segment'", "Did you mean three-segment?"),
    (("flutter", "."), "MODEL", "'.'", "folder", "Name the TOML file"),
    # --fold
    (("modes", "goland", "--fold", "30"), "--fold", "'30'", "no hinge", "Leave the option out"),
    (("modes", "goland", "--fold2", "30"), "--fold2", "'30'", "no hinge", "Leave the option out"),
    (("modes", "goland", "--fold2", "level"), "--fold2", "'level'", "no hinge", "Leave"),
    (("modes", THREE, "--fold", "30"), "--fold", "'30'", "2 angles", "--fold 30,-75"),
    (("flutter", THREE, "--fold", "1,2,3"), "--fold", "'1,2,3'", "2 angles", "--fold 30,-75"),
    (("modes", THREE, "--fold", "30,abc"), "--fold", "'30,abc'", "2 angles", "--fold 30,-75"),
    (("modes", THREE, "--fold", "30,"), "--fold", "'30,'", "2 angles", "--fold 30,-75"),
    (("modes", THREE, "--fold", ""), "--fold", "''", "2 angles", "--fold 30,-75"),
    (("modes", THREE, "--fold", "nan,0"), "--fold", "'nan,0'", "2 angles", "--fold 30,-75"),
    (("modes", THREE, "--fold", "0,inf"), "--fold", "'0,inf'", "2 angles", "--fold 30,-75"),
    # --foldI
    (("modes", THREE, "--fold2", "--json"), "--fold2", "missing", "needs an angle", "--fold2 30"),
    (("modes", THREE, "--fold2"), "--fold2", "missing", "needs an angle", "--fold2 30"),
    (("modes", THREE, "--fold2="), "--fold2", "missing", "needs an angle", "--fold2 30"),
    (("modes", THREE, "--fold1", "3"), "--fold1", "'3'", "hinges 2 to 3", "segments I-1 and I"),
    (("modes", THREE, "--fold4", "3"), "--fold4", "'3'", "hinges 2 to 3", "segments I-1 and I"),
    (("modes", THREE, "--fold-of", "x"), "--fold-of", "'x'", "a hinge", "--fold2 30"),
    (("modes", THREE, "--fold2", "1", "--fold2", "2"), "--fold2", "'2'", "already", "once"),
    (("modes", THREE, "--fold2", "lvel"), "--fold2", "'lvel'", "numbers", "or level"),
    (("modes", THREE, "--fold2", "0:10"), "--fold2", "'0:10'", "start:stop:step", "0:150:2.5"),
    (("modes", THREE, "--fold2", "::"), "--fold2", "'::'", "numbers", "0:150:2.5"),
    (("modes", THREE, "--fold2", "1:2:3:4"), "--fold2", "'1:2:3:4'", "start:stop:step", "0:150"),
    (("modes", THREE, "--fold2", "0:nan:1"), "--fold2", "'0:nan:1'", "finite", "0:150:2.5"),
    (("modes", THREE, "--fold2", "0:inf:1"), "--fold2", "'0:inf:1'", "finite", "0:150:2.5"),
    (("modes", THREE, "--fold2", "0:10:0"), "--fold2", "'0:10:0'", "not be zero", "2.5"),
    (("modes", THREE, "--fold2", "10:0:5"), "--fold2", "'10:0:5'", "start to stop", "0:10:5"),
    (("modes", THREE, "--fold2", "0:1e9:1e-6"), "--fold2", "1e9", "at most 100000", "larger step"),
    (("modes", THREE, "--fold2", "0:1:1e-320"), "--fold2", "1e-320", "100000", "larger step"),
    (("boundary", THREE, *GRID), "--fold", "1002001", "at most 100000", "larger steps"),
    (
        ("flutter", THREE, "--fold2", "0:10:5"),
        "--fold2: got '0:10:5'",
        "one set",
        "not 3",
        "foldwing boundary",
    ),
    # --speeds
    (("flutter", THREE, "--speeds", "60:0:1"), "--speeds", "'60:0:1'", "start to stop", "0:60:1"),
    (("flutter", THREE, "--speeds", "0:60:-1"), "--speeds", "'0:60:-1'", "start to stop", "0:60:1"),
    (("flutter", THREE, "--speeds", "60:0:-1"), "--speeds", "'60:0:-1'", "ascend", "0:60:1"),
    (("flutter", THREE, "--speeds", "0:60:0"), "--speeds", "'0:60:0'", "not be zero", "2.5"),
    (("flutter", THREE, "--speeds", "-10:60:1"), "--speeds", "-10:60:1", "negative", "0:60:1"),
    (("flutter", THREE, "--speeds", "0"), "--speeds", "'0'", "only 0 m/s", "0:60:1"),
    (("flutter", THREE, "--speeds", ""), "--speeds", "''", "numbers", "0:60:1"),
    (("flutter", THREE, "--speeds", "nan"), "--speeds", "'nan'", "finite", "0:60:1"),
    (("flutter", THREE, "--speeds", "0:inf:1"), "--speeds", "'0:inf:1'", "finite", "0:60:1"),
    (("flutter", THREE, "--speeds", "0:1e7:1"), "--speeds", "1e7", "at most 100000", "larger step"),
    # lists
    (("modes", THREE, "--fold2", "0,x,60"), "--fold2", "'0,x,60'", "made of numbers", "0,60,90"),
    (("modes", THREE, "--fold2", "0,,60"), "--fold2", "'0,,60'", "made of numbers", "0,60,90"),
    (("modes", THREE, "--fold2", "0,inf"), "--fold2", "'0,inf'", "finite", "0,60,90"),
    (("modes", THREE, "--fold2", "0,10:0:5"), "--fold2", "'0,10:0:5'", "start to stop", "0:10:5"),
    (("modes", THREE, "--fold2", "0,1:2"), "--fold2", "'0,1:2'", "or a list", "0,60,90"),
    (("flutter", THREE, "--speeds", "0,40,20"), "--speeds", "'0,40,20'", "ascend", "0:60:1"),
    # steady
    (("steady", THREE, "--alpha", "21"), "--alpha", "21.0", "-20 to 20 degrees", "stall"),
    (("steady", THREE, "--alpha", "nan"), "--alpha", "nan", "-20 to 20 degrees", "linear"),
    (("steady", THREE, "--alpha", "5deg"), "--alpha", "'5deg'", "a number", "--alpha 5"),
    (("steady", THREE, "--speed", "0"), "--speed", "0.0", "0.001 to 100000 m/s", "such as 20"),
    (("steady", THREE, "--gap", "20 cm"), "--gap", "0.2", "gaps must leave some", "narrower"),
    (("steady", THREE, "--gap", "-1 mm"), "--gap", "-1 mm", "at least 0"),
    (("steady", THREE, "--panels", "8x2"), "--panels", "2", "each of 3 segments", "larger"),
    (("steady", THREE, "--basis", "converged"), "--basis", "-h"),
    # numbers
    (("flutter", THREE, "--max-speed", "0"), "--max-speed", "0.0", "0.001 to 100000 m/s", "as 60"),
    (("boundary", THREE, "--max-speed", "-5"), "--max-speed", "-5.0", "0.001 to", "as 60"),
    (("boundary", THREE, "--max-speed", "nan"), "--max-speed", "nan", "0.001 to", "as 60"),
    (("flutter", THREE, "--max-speed", "inf"), "--max-speed", "inf", "0.001 to", "as 60"),
    (("flutter", THREE, "--max-speed", "60m/s"), "--max-speed", "'60m/s'", "a number", "unit"),
    (("flutter", THREE, "--damping", "-1"), "--damping", "-1.0", "at least 0", "0.01"),
    (("boundary", THREE, "--damping", "nan"), "--damping", "nan", "finite", "0.01"),
    (("flutter", THREE, "--damping", "2 %"), "--damping", "'2 %'", "a number", "--damping 0.01"),
    (("flutter", THREE, "--damping-threshold", "0.9"), "--damping-threshold", "0.9", "less than"),
    (("boundary", THREE, "--jobs", "0"), "--jobs", "'0'", "1 or more", "--jobs 4"),
    (("boundary", THREE, "--jobs", "1.5"), "--jobs", "'1.5'", "whole number", "--jobs 4"),
    # choices and commands, worded by the parser
    (("flutter", THREE, "--aero", "latice"), "--aero", "latice", "quasi-steady", "-h"),
    (("modes", THREE, "--basis", "foo"), "--basis", "foo", "free-free", "-h"),
    (("flutter", THREE, "--frob"), "--frob", "-h"),
    (("flutter",), "Missing argument", "-h"),
    (("flutter", THREE, "more"), "more", "-h"),
    (("frob",), "frob", "-h"),
    # measured points
    (("boundary", THREE, "--measured", "no.csv"), "--measured", "no.csv", "No such", "level-tip"),
    (("modes", THREE, "--measured", "."), "--measured", "'.'", "can be read", "header has fold_2"),
    # convergence
    (
        ("convergence", THREE, "--fold2", "0:9:3"),
        "--fold2: got '0:9:3'",
        "convergence takes one",
        "not 4",
    ),
    (
        ("convergence", THREE, "--vary", "chord"),
        "--vary",
        "'chord'",
        "chordwise, spanwise",
        "--vary chordwise",
    ),
    (("convergence", THREE, "--vary", ""), "--vary", "''", "chordwise, spanwise"),
    (("convergence", THREE, "--vary", "wake"), "--vary", "'wake'", "strip", "Add --aero lattice"),
    ((*LATTICE, "--vary", "gap"), "--vary", "'gap'", "not depend", '--gap "1 mm"'),
    ((*LATTICE, "--levels", "wake"), "--levels", "'wake'", "numbers", "chordwise=4,8,16"),
    ((*LATTICE, "--levels", "wak=3"), "--levels", "'wak=3'", "name one of", "chordwise=4,8,16"),
    ((*LATTICE, "--levels", "wake=0"), "--levels", "'wake=0'", "greater than 0", "chordwise=4"),
    ((*LATTICE, "--levels", "wake=nan"), "--levels", "'wake=nan'", "finite", "chordwise=4"),
    ((*LATTICE, "--levels", "wake=2,a"), "--levels", "'wake=2,a'", "numbers", "chordwise=4"),
    ((*LATTICE, "--levels", "chordwise=4.5"), "--levels", "chordwise=4.5", "a whole number"),
    ((*LATTICE, "--levels", "wake=1e9"), "--levels", "wake=1000000000.0", "at most 10000"),
    ((*LATTICE, "--levels", "wake=" + "1," * 200), "--levels", "201 values", "at most 100"),
    ((*LATTICE, "--levels", "wake=2", "--levels", "wake=3"), "--levels", "already", "once"),
    ((*LATTICE, "--vary", "wake", "--levels", "gap=0"), "--levels", "'gap'", '--gap "1 mm"'),
    ((*LATTICE, "--vary", "wake", "--levels", "chordwise=4"), "--levels", "not among --vary"),
    # examples
    (("examples", "golan"), "'golan'", "Did you mean goland?", "hale"),
    (("examples", "--copy", "x.toml"), "NAME", "missing", "--copy", "name first"),
    (("examples", "goland", "--copy", "no/x.toml"), "--copy", "no/x.toml", "cannot", "another"),
]


@pytest.mark.usefixtures("no_computing")
@pytest.mark.parametrize(("arguments", "words"), [(case[0], case[1:]) for case in CASES])
def test_wrong_input(cli, empty_folder, arguments, words):
    answer = cli(*arguments)
    assert answer.status == 2
    assert answer.out == ""
    message = " ".join(answer.err.replace("│", " ").split())
    for word in words:
        assert word in message
    assert list(empty_folder.iterdir()) == []


MODELS = [
    ('span = "14 cm"', 'span = "14 kg"', "wing.segment[1].span", "'14 kg'", "a length", '"14 cm"'),
    ('span = "14 cm"', 'span = "-14 cm"', "wing.segment[1].span", "-14 cm", "greater than 0"),
    ('span = "14 cm"', 'spam = "14 cm"', "wing.segment[1].spam", "Did you mean span?"),
    ("thickness", "thikness", "wing.thikness", "not a known key", "Did you mean thickness?"),
    ("density = 1145", "density = nan", "material.sheet.density", "nan", "finite", "kg/m^3"),
    ("fold = 30", 'fold = "30 m"', "wing.segment[2].hinge.fold", "'30 m'", "an angle"),
    ("springs = 3", "springs = 0", "wing.segment[2].hinge.springs", "0", "1 to 1000"),
    ('material = "sheet"', 'material = "sheat"', "wing.material", "Did you mean sheet?"),
    ("[wing]", "[wing", "valid TOML", "wing"),
    ("[wing]", "[wimg]", "wimg", "Did you mean wing?"),
]


@pytest.mark.usefixtures("no_computing")
@pytest.mark.parametrize("command", ["modes", "flutter", "boundary"])
@pytest.mark.parametrize(("old", "new", "words"), [(case[0], case[1], case[2:]) for case in MODELS])
def test_wrong_model(cli, empty_folder, command, old, new, words):
    path = empty_folder / "own.toml"
    path.write_text(MODEL.replace(old, new), encoding="utf-8")
    answer = cli(command, "own.toml", "--json")
    assert (answer.status, answer.out) == (2, "")
    assert answer.err.startswith("Error: ")
    assert answer.err.count("\n") == 1
    for word in words:
        assert word in answer.err
    assert list(empty_folder.iterdir()) == [path]


def test_that_model_is_right_otherwise(cli, empty_folder):
    (empty_folder / "own.toml").write_text(MODEL, encoding="utf-8")
    assert cli("flutter", "own.toml", "--json").json["certified"]


@pytest.mark.usefixtures("no_computing")
@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", ("header",)),
        ("fold_2,speed\n", ("a row",)),
        ("fold_2,sped\n1,2\n", ("column speed or frequency",)),
        ("fold_3,speed\n1,2\n", ("column fold_2", "swept")),
        ("fold_2,speed\n1,2\n# x\n3\n", ("line 4", "2 values")),
        ("fold_2,speed\n\n1,fast\n", ("line 3", "column speed", "'fast'", "finite number")),
        ("fold_2,speed\n1,inf\n", ("line 2", "'inf'", "finite number")),
        ("fold_2,speed,speed\n1,2,3\n", ("twice",)),
        ("fold_2;speed\n1;2\n", ("column speed or frequency",)),
        (b"\xff\xfe\x00", ("UTF-8",)),
    ],
)
def test_wrong_table_of_measurements(cli, empty_folder, text, words):
    path = empty_folder / "own.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    answer = cli("boundary", THREE, "--fold2", "0:10:10", "--measured", "own.csv", "--out", "x")
    assert (answer.status, answer.out) == (2, "")
    for word in ("--measured", "own.csv", *words, "Write a CSV file"):
        assert word in answer.err
    assert list(empty_folder.iterdir()) == [path]


def test_example_is_not_copied_over_a_file(cli, empty_folder):
    path = empty_folder / "mine.toml"
    path.write_text("mine", encoding="utf-8")
    answer = cli("examples", "goland", "--copy", "mine.toml")
    assert answer.status == 2
    assert "mine.toml exists already. Give the name of a new file." in answer.err
    assert path.read_text(encoding="utf-8") == "mine"


def test_exit_status_of_the_program(shell):
    assert shell("modes", "nosuch").status == 2
    assert shell("modes", "goland", "--json").status == 0
