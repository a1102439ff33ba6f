# Puts the parts of the page together: cmake -DPAGE=… -DPARTS=… -DOUT=… -P viewer/page.cmake
file(READ ${PAGE}/index.html page)
foreach(part STYLE CORE WORKER MAIN)
  file(READ ${PARTS}/${part} text)
  string(STRIP "${text}" text)
  string(REPLACE "@${part}@" "${text}" page "${page}")
endforeach()
file(WRITE ${OUT} "${page}")
