"""shoot.py FORM_FACTORS.csv ELEMENTS.csv SHOTS: prints the radiosity of each surface after some shots, red band."""
import csv
import sys

EMISSION = {"light": 22.0}  # 0 for the others
PAINT = {"wall-right": 0.1, "wall-left": 0.62, "light": 0.5}


def reflectance(name):
    return 0.7 if name.startswith("box") else PAINT.get(name, 0.74)


form_factor = {}  # of (from, to)
with open(sys.argv[1]) as file:
    for line in csv.DictReader(file):
        form_factor[line["from"], line["to"]] = float(line["form_factor"])
with open(sys.argv[2]) as file:
    area = {line["surface"]: float(line["area"]) for line in csv.DictReader(file)}
names = list(area)

radiosity = {name: EMISSION.get(name, 0.0) for name in names}
unshot = dict(radiosity)  # radiosity that was not shot yet
for shot in range(int(sys.argv[3])):
    shooter = names[shot % len(names)]  # wrong: this one may have little to shoot
    for name in names:
        # The flux that the shooter sends to this surface is form_factor[shooter, name] * unshot[shooter] * area[shooter].
        pass
for name in names:
    print(f"{name},{radiosity[name]}")
