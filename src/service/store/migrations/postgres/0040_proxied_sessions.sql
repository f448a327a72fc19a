-- Whom a reverse proxy named when a session was opened; none where it named nobody.
ALTER TABLE teacher_sessions ADD COLUMN proxied_name TEXT;
