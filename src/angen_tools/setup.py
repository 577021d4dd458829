"""Lets catkin put the angen_tools package on the Python path; not to be called by hand."""
from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(packages=['angen_tools'], package_dir={'': 'src'},
                                 package_data={'angen_tools': ['standards/*.yaml']}))
