"""Canvas: its download and its gradebook."""
