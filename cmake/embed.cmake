# Writes coast_data.c, which holds the files of coasts as strings:
#   cmake -DDATA=FOLDER -DOUT=FILE -P cmake/embed.cmake
set(text "#include \"coast/coast.h\"\n")
foreach(size 110m 50m 10m)
  file(READ ${DATA}/coast-${size}.bin bytes HEX)
  string(LENGTH "${bytes}" digits)
  math(EXPR count "${digits} / 2")
  # a string is compiled in a thirtieth of the time that numbers take
  string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${bytes}")
  string(APPEND text "\nconst size_t fg__coast_${size}_size = ${count};\n"
    "const unsigned char fg__coast_${size}[] =\n  \"${bytes}\";\n")
endforeach()
file(WRITE ${OUT} "${text}")
