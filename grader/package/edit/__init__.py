"""package.edit"""
