"""verdict.checks"""
