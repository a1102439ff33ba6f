# Writes the page for browsers as a string, ended by a zero:
#   cmake -DPAGE=FILE -DOUT=FILE -P cmake/embed_page.cmake
file(READ ${PAGE} bytes HEX)
string(LENGTH "${bytes}" digits)
math(EXPR count "${digits} / 2")
string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${bytes}")
file(WRITE ${OUT} "#include \"write/view/parts.h\"\n"
  "\nconst size_t fg__view_page_size = ${count};\n"
  "const unsigned char fg__view_page[] =\n  \"${bytes}\";\n")
