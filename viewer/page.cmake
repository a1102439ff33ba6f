# Puts the parts of a page together: cmake -DPAGE=… -DPARTS=… -DOUT=… -P viewer/page.cmake
file(READ ${PAGE}/index.html page)
file(GLOB parts RELATIVE ${PARTS} ${PARTS}/*)
foreach(part IN LISTS parts)
  file(READ ${PARTS}/${part} text)
  string(STRIP "${text}" text)
  string(REPLACE "@${part}@" "${text}" page "${page}")
endforeach()
file(WRITE ${OUT} "${page}")
