# Writes a page for browsers as a string fg__NAME_page, ended by a zero:
#   cmake -DNAME=… -DPAGE=FILE -DOUT=FILE -P cmake/embed_page.cmake
file(READ ${PAGE} bytes HEX)
string(LENGTH "${bytes}" digits)
math(EXPR count "${digits} / 2")
string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${bytes}")
file(WRITE ${OUT} "#include \"write/view/parts.h\"\n"
  "\nconst size_t fg__${NAME}_page_size = ${count};\n"
  "const unsigned char fg__${NAME}_page[] =\n  \"${bytes}\";\n")
