"""One verdict: from an order through the checks to the report."""
