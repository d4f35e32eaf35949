"""The window: a page in the browser with the turtle, the graph, the log, plots and parameters."""
