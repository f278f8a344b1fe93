"""What Sphinx needs to make the web site out of the pages that scripts/site lays out for it."""

project = "TouchAFM"
html_title = "TouchAFM"
extensions = ["myst_parser"]
html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sphinx = False
myst_heading_anchors = 4
smartquotes = False  # k' and a double hyphen stay as they are
# the site shows the pages in the order of contents.toml; a page is also reached by the links of others
suppress_warnings = ["toc.not_included"]
