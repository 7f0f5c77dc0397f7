# remap_install_manuals(TOOL MAN SHARE COMPLETIONS): the manual pages of TOOL below the folder MAN of an installation, its completion for
# bash, zsh and fish, from the folder COMPLETIONS, below SHARE.
function(remap_install_manuals tool man share completions)
  file(GLOB pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/man/${tool}*.1)
  install(FILES ${pages} DESTINATION ${man}/man1)
  install(FILES ${completions}/bash/${tool} DESTINATION ${share}/bash-completion/completions)
  install(FILES ${completions}/zsh/_${tool} DESTINATION ${share}/zsh/site-functions)
  install(FILES ${completions}/fish/${tool}.fish DESTINATION ${share}/fish/vendor_completions.d)
endfunction()
