# `cmake --install` and `cpack -G DEB`: programs in lib/coop (coop_node() and launcher/ put them there), the front door in
# bin, configuration and maps in share/coop, where the launcher looks for them.
install(PROGRAMS coop DESTINATION bin)
# The verbs that build and test stay with the sources.
install(DIRECTORY launcher/verbs/ DESTINATION share/coop/verbs REGEX "/(build|test|maintain)\\.sh$" EXCLUDE)
install(DIRECTORY config maps DESTINATION share/coop)
install(FILES README.md DESTINATION share/doc/coop OPTIONAL)
install(DIRECTORY docs/ DESTINATION share/doc/coop OPTIONAL FILES_MATCHING PATTERN "*.md" PATTERN "*.png")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME coop)
set(CPACK_PACKAGE_VENDOR "Coop")
set(CPACK_PACKAGE_CONTACT "The Coop authors <coop@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "DDS components for robots that work in barns")
set(CPACK_PACKAGE_DESCRIPTION "Mapping, localisation, planning, driving and picking as separate programs over Fast DDS,
composed into a robot by a YAML launch file, with a simulator that stands in for the robot and its barn.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS bash)
include(CPack)
