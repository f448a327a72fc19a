-- Whether what is typed is still graded after the end of handing in, as practice.
ALTER TABLE assignments ADD COLUMN practice BIGINT NOT NULL DEFAULT 1;
