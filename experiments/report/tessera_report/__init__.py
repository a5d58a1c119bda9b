"""Reports of a sweep's rows: a page, figures and an export."""
