# Replace this line by the start of your program, in any language.
python3 rasterizer.py "$1" "$2"
