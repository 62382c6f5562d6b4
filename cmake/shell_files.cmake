# What an installed edda brings along for the shell: its manual page and completions, printed by the program itself,
# so that they say what it can do.
include(GNUInstallDirs)

set(shell_folder ${CMAKE_CURRENT_BINARY_DIR}/shell)
string(TIMESTAMP shell_date "%Y-%m-%d" UTC)  # SOURCE_DATE_EPOCH, where it is set

function(edda_prints file)
  add_custom_command(
    OUTPUT ${shell_folder}/${file}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${shell_folder}
    COMMAND edda ${ARGN} > ${shell_folder}/${file}
    DEPENDS edda
    VERBATIM)
  set(shell_files ${shell_files} ${shell_folder}/${file} PARENT_SCOPE)
endfunction()

edda_prints(edda.1 man --date ${shell_date})
edda_prints(edda completion bash)
edda_prints(_edda completion zsh)
edda_prints(edda.fish completion fish)
add_custom_target(edda_shell_files ALL DEPENDS ${shell_files})

install(FILES ${shell_folder}/edda.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${shell_folder}/edda DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
# zsh looks into vendor-completions below Debian's /usr alone; the prefix is known only when installing.
install(CODE "
  set(folder site-functions)
  if(CMAKE_INSTALL_PREFIX MATCHES \"^/usr/?\$\")
    set(folder vendor-completions)
  endif()
  file(INSTALL ${shell_folder}/_edda DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/zsh/\${folder}\")
")
install(FILES ${shell_folder}/edda.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
