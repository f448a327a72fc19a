<!doctype html><title>404</title><h1>Not Found</h1>
