# Bundles the replay page (src/view/page) with npm and writes it into a .cpp, in two parts: before and behind the run.
# The packages are those of package-lock.json, to the byte.
function(replay_page source output)
  if(NOT EDDA_VIEW)
    file(CONFIGURE OUTPUT ${output} CONTENT
      "#include \"view/page.hpp\"\n\nedda::PageTemplate edda::page_template() { return {}; }\n" @ONLY)
    return()
  endif()
  find_program(NODE node)
  find_program(NPM npm)
  if(NOT NODE OR NOT NPM)
    message(FATAL_ERROR "node and npm are needed for the page of edda view: run tools/setup, or configure with -DEDDA_VIEW=OFF")
  endif()
  set(work ${CMAKE_CURRENT_BINARY_DIR}/page)
  file(GLOB_RECURSE scripts CONFIGURE_DEPENDS ${source}/src/*.ts)
  set(files package.json package-lock.json build.mjs index.html style.css tsconfig.json)
  list(TRANSFORM files PREPEND ${source}/)
  add_custom_command(OUTPUT ${work}/packages
    COMMAND ${CMAKE_COMMAND} -E make_directory ${work}
    COMMAND ${CMAKE_COMMAND} -E copy ${source}/package.json ${source}/package-lock.json ${work}
    COMMAND ${NPM} ci --omit=dev --no-audit --no-fund --loglevel=error --prefix ${work}
    COMMAND ${CMAKE_COMMAND} -E touch ${work}/packages
    DEPENDS ${source}/package.json ${source}/package-lock.json
    COMMENT "Fetching what the replay page is made with" VERBATIM)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -E copy ${files} ${work}
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${work}/src
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${source}/src ${work}/src
    COMMAND ${NODE} ${work}/build.mjs ${work}/page.html
    COMMAND ${CMAKE_COMMAND} -D PAGE=${work}/page.html -D OUTPUT=${output} -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/embed_page.cmake
    DEPENDS ${work}/packages ${scripts} ${files} ${CMAKE_CURRENT_SOURCE_DIR}/cmake/embed_page.cmake
    COMMENT "Bundling the replay page" VERBATIM)
endfunction()
