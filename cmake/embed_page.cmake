# Writes a page for browsers as a string, ended by a zero, in NAME and NAME_size, which HEADER
# declares:
#   cmake -DPAGE=FILE -DNAME=NAME -DHEADER=HEADER -DOUT=FILE -P cmake/embed_page.cmake
file(READ ${PAGE} bytes HEX)
string(LENGTH "${bytes}" digits)
math(EXPR count "${digits} / 2")
string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${bytes}")
file(WRITE ${OUT} "#include \"${HEADER}\"\n"
  "\nconst size_t ${NAME}_size = ${count};\n"
  "const unsigned char ${NAME}[] =\n  \"${bytes}\";\n")
